/// @file SlipRecovery.h
/// @brief Notices that the robot has not moved as its odometry says, and finds out how it has.
#pragma once

#include "slam/filter/FilterOptions.h"
#include "slam/filter/Particle.h"
#include "slam/filter/PreparedScan.h"
#include "slam/grid/ScanMatcher.h"

namespace hybrid_slam {

/// Where the matches of a step begin, for all particles.
struct StepMotion {
  mrpt::math::TPose2D odometry;  ///< m, rad; in the robot frame at the start of the step
  mrpt::math::TPose2D start;     ///< the same of the best particle's match: where the others' begin
  bool hasSlipped = false;       ///< the odometry is worth nothing
};

/// Once a step, in the best particle's map: the scan is matched from where the odometry says, which is where
/// the other particles' matches then begin. If it fits much worse than the scans before, a wide window around
/// is searched.
///
/// The motion is a mixture: that of the motion model, or (slip_probability) a slip, anywhere in the window. A
/// place far off the motion model is taken if, with these odds, scan and motion are more likely there.
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
  double usualFit_ = 0;  ///< of the scans so far, the newest counting most
};

/// The motion model's distribution of the pose after a step; after a slip as wide as the searched window.
MotionDistribution motionAfter(const Particle& before, const StepMotion& motion,
                               const MotionModelOptions& model, const ImprovedProposalOptions& options);

}  // namespace hybrid_slam
