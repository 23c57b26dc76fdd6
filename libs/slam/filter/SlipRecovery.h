/// @file SlipRecovery.h
/// @brief Detects wheel slip and recovers the true motion.
#pragma once

#include "slam/filter/FilterOptions.h"
#include "slam/filter/Particle.h"
#include "slam/filter/PreparedScan.h"
#include "slam/grid/ScanMatcher.h"

namespace hybrid_slam {

/// Starting point of a step's scan matches, common to all particles.
struct StepMotion {
  mrpt::math::TPose2D odometry;  ///< m, rad; in the robot frame at the start of the step
  mrpt::math::TPose2D start;     ///< motion of the best particle's match: start of the other matches
  bool hasSlipped = false;       ///< odometry rejected
};

/// Once per step, the scan is matched to the best particle's map from the odometry; the result starts the
/// other particles' matches. If it fits much worse than earlier scans, a wide window is searched.
///
/// The motion is a mixture of the motion model and, with slip_probability, a uniform distribution over the
/// window. A pose far from the motion model is accepted if its posterior under this mixture is higher.
class SlipRecovery {
 public:
  explicit SlipRecovery(const FilterConfiguration& configuration);
  StepMotion motionOf(const Particle& best, const mrpt::math::TPose2D& odometry, const PreparedScan& scan);

 private:
  ImprovedProposalOptions options_;
  MotionModelOptions motion_;
  double exponent_;  ///< of w_grid
  ScanMatcher matcher_;
  GridWeight gridWeight_;
  double usualFit_ = 0;  ///< running mean of the fit, recent scans weighted most
};

/// The motion model's distribution of the pose after a step; after a slip, as wide as the search window.
MotionDistribution motionAfter(const Particle& before, const StepMotion& motion,
                               const MotionModelOptions& model, const ImprovedProposalOptions& options);

}  // namespace hybrid_slam
