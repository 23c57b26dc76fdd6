#include "slam/filter/SlipRecovery.h"

#include <algorithm>
#include <cmath>

#include "slam/grid/CorrelativeSearch.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

constexpr double kPoorFit = 0.8;     // of the usual fit: search below this
constexpr double kForgetting = 0.1;  // weight of the newest scan in the usual fit
constexpr size_t kPlaces = 8;        // starting points of the local optimisation

}  // namespace

SlipRecovery::SlipRecovery(const FilterConfiguration& c)
    : options_(c.improved),
      motion_(c.motion),
      exponent_(c.gridWeight.exponent),
      matcher_(c.matcher),
      gridWeight_(c.gridWeight, c.grid.resolution) {}

StepMotion SlipRecovery::motionOf(const Particle& best, const TPose2D& odometry, const PreparedScan& scan) {
  const TPose2D before = best.path.back();
  StepMotion motion{odometry, odometry, false};
  if (options_.slipDistance <= 0) return motion;
  const MotionDistribution expected = motionAfter(best, motion, motion_, options_);
  const Eigen::Matrix3d information = expected.covariance.inverse();
  const auto asExpected = [&](const TPose2D& pose) {
    return gaussianLogDensity(pose, expected.mean, information);
  };
  ScanMatch match = matcher_.match(scan.matchedBeams, expected.mean, best.grid, asExpected);

  if (match.fit < kPoorFit * usualFit_) {
    const SearchWindow window{options_.slipDistance, options_.slipAngle};
    // ln of the density of a slip over that of the motion model at its mean.
    const double slip =
        std::log(options_.slipProbability / (8 * window.distance * window.distance * window.angle)) +
        0.5 * std::log(expected.covariance.determinant() * std::pow(2 * M_PI, 3));
    const Prior anywhere = [](const TPose2D&) { return LogDensity(); };
    // Compare by w_grid, which allows beams to end in unknown cells. The matcher's likelihood prefers any
    // wall, and would pull the robot back along a partly seen corridor.
    const auto logWeight = [&](const TPose2D& pose) {
      return exponent_ * gridWeight_.logWeight(scan.weighedBeams, scan.scans, pose, best.grid);
    };
    double highest = logWeight(match.pose) + asExpected(match.pose).value;
    for (const TPose2D& place :
         correlativeSearch(scan.matchedBeams, expected.mean, best.grid, window, kPlaces)) {
      const ScanMatch there = matcher_.match(scan.matchedBeams, place, best.grid, anywhere);
      const double modelled = asExpected(there.pose).value;
      const double value = logWeight(there.pose) + std::max(modelled, slip);
      if (value <= highest) continue;
      highest = value, match = there;
      motion.hasSlipped = slip > modelled;
    }
  }
  if (motion.hasSlipped || match.fit >= options_.minFit) motion.start = match.pose - before;
  usualFit_ = usualFit_ == 0 ? match.fit : (1 - kForgetting) * usualFit_ + kForgetting * match.fit;
  return motion;
}

MotionDistribution motionAfter(const Particle& before, const StepMotion& motion,
                               const MotionModelOptions& model, const ImprovedProposalOptions& options) {
  MotionDistribution distribution =
      motionDistribution(before.path.back(), motion.odometry, before.motion.model(model));
  distribution.covariance.diagonal().array() +=
      1e-8;  // (0.1 mm, 0.1 mrad)^2: without noise it has no inverse
  if (motion.hasSlipped) {
    const double distance = options.slipDistance, angle = options.slipAngle;
    distribution.covariance.diagonal() +=
        Eigen::Vector3d(distance * distance, distance * distance, angle * angle);
  }
  return distribution;
}

}  // namespace hybrid_slam
