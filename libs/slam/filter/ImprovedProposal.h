/// @file ImprovedProposal.h
/// @brief The proposal of Grisetti et al. (the paper's [5]): sample around a scan match.
#pragma once

#include "base/RandomStream.h"
#include "slam/filter/SlipRecovery.h"
#include "slam/filter/WeightTerms.h"

namespace hybrid_slam {

/// A pose drawn for a particle, and its incremental weight.
struct Proposed {
  mrpt::math::TPose2D pose;
  double logWeight = 0;   ///< ln p(scan | previous pose, odometry, grid, lines), up to a constant of the step
  double fit = 0;         ///< of the match, in [0, 1]
  bool isMatched = true;  ///< false: drawn from the motion model or around the place found after a slip
  LineWeight lineWeight;
};

/// The target density of a step is  p(x) = p(scan | x, grid) p(lines | x, database) p(features | x, database)
/// p(x | x', odometry). Scan matching finds its maximum and a normal approximation there. Poses sampled from
/// it, with importance weights, give the mean and covariance of the proposal. Their mean weight estimates the
/// integral of p, which is the particle's incremental weight, independent of the pose drawn. In directions
/// the scan does not constrain, as along a corridor, the motion model's uncertainty remains.
///
/// If the match fits the map worse than min_fit, the pose is drawn from the motion model (after a slip:
/// around the place that the search found) with weight p(scan | x, grid) p(lines | x, database). Its
/// expectation is the same integral, so matched and unmatched particles are comparable. (ParticleSet then
/// tempers both.)
class ImprovedProposal {
 public:
  ImprovedProposal(const ImprovedProposalOptions& options, const MotionModelOptions& motion,
                   const ScanMatcherOptions& matcher, const WeightTerms& terms);

  Proposed propose(const Particle& particle, const StepMotion& motion, const PreparedScan& scan,
                   RandomStream& random) const;

 private:
  ImprovedProposalOptions options_;
  MotionModelOptions motion_;
  WeightTerms terms_;
  ScanMatcher matcher_;
};

}  // namespace hybrid_slam
