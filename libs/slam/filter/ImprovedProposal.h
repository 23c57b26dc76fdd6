/// @file ImprovedProposal.h
/// @brief The proposal of Grisetti et al. (the paper's [5]): sample around a scan match.
#pragma once

#include "base/RandomStream.h"
#include "slam/filter/LineLikelihood.h"
#include "slam/filter/SlipRecovery.h"

namespace hybrid_slam {

/// A pose drawn for a particle, and what that does to its weight.
struct Proposed {
  mrpt::math::TPose2D pose;
  double logWeight = 0;  ///< ln of p(scan | pose before, odometry, grid, lines), up to a constant of the step
  double fit = 0;        ///< of the match, in [0, 1]
  bool isMatched = true;  ///< false: drawn from the motion model, because no match was good enough
  LineWeight lineWeight;
};

/// The target density of a step is  p(x) = p(scan | x, grid) p(lines | x, database) p(x | x', odometry).  A
/// match finds its top; poses drawn from the normal distribution that the match makes out there, each weighed
/// by p over that distribution, give the proposal its mean and covariance, and their mean weight is the
/// particle's own: the integral of p, which does not depend on the pose that is drawn in the end. Where the
/// scan says nothing, as along a corridor, the motion model keeps its uncertainty.
///
/// A match that fits the map less than min_fit is not used: the pose is drawn from the motion model, and the
/// weight is p(scan | x, grid) p(lines | x, database) there. Its mean over such draws is the same integral,
/// so that matched and unmatched particles can be compared. (ParticleSet tempers both, after that.)
class ImprovedProposal {
 public:
  explicit ImprovedProposal(const FilterConfiguration& configuration);

  Proposed propose(const Particle& particle, const StepMotion& motion, const PreparedScan& scan,
                   RandomStream& random) const;

 private:
  ImprovedProposalOptions options_;
  MotionModelOptions motion_;
  bool useLines_;
  LineLikelihoodOptions lines_;
  LineWeightOptions lineWeight_;
  ScanMatcher matcher_;
};

}  // namespace hybrid_slam
