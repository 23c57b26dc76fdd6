/// @file StuckOdometry.h
/// @brief The robot's motion while its odometry stands still.
#pragma once

#include <optional>

#include "base/LaserScan.h"
#include "base/ScanState.h"
#include "slam/filter/ScanOdometry.h"

namespace hybrid_slam {

/// Replaces odometry that stands still while the robot drives, as after a lost connection to its base. While
/// the odometry does not change, the scans are matched to each other. If their motion explains more beams by
/// the last scan before than standing does, it is used until the odometry agrees with it again. Motion along
/// a corridor that shows nothing remains unnoticed.
class StuckOdometry {
 public:
  StuckOdometry(const GridOptions& grid, const ScanMatcherOptions& matcher);

  /// Returns the motion since the previous scans, in the robot frame at those (m, rad). At the scan that
  /// reveals that the odometry is stuck, it includes the motion since the odometry last changed.
  /// @param odometry   since the previous scans (m, rad)
  /// @param timestamp  s
  mrpt::math::TPose2D motionTo(const mrpt::math::TPose2D& odometry, const Scans& scans, double timestamp);

  bool isStuck() const { return isStuck_; }

  template <class State>
  void visit(State& state) {
    bool matches = scanOdometry_.has_value();
    state(isStuck_, distrusted_, lastScans_, lastMotion_, lastTime_, lastDuration_, stoodSince_, moved_,
          matches);
    for (const auto& scan : lastScans_) state.check(scan != nullptr, "a scan is missing");
    if constexpr (State::kIsReading) {
      scanOdometry_.reset();
      if (matches) scanOdometry_.emplace(grid_, matcher_);
    }
    if (scanOdometry_) state(*scanOdometry_);
  }

 private:
  mrpt::math::TPose2D matched(const Scans& scans, double timestamp);
  void keep(const mrpt::math::TPose2D& motion, const Scans& scans, double timestamp);
  bool isStandingRefuted(const Scans& scans, const mrpt::math::TPose2D& moved) const;

  GridOptions grid_;
  ScanMatcherOptions matcher_;
  bool isStuck_ = false;
  size_t distrusted_ = 0;                     ///< changes of the odometry since it was stuck
  Scans lastScans_;                           ///< before the odometry stood still, or the first
  mrpt::math::TPose2D lastMotion_;            ///< to these
  double lastTime_ = 0, lastDuration_ = 0;    ///< s, of these scans and of that motion
  double stoodSince_ = 0;                     ///< s
  mrpt::math::TPose2D moved_;                 ///< by the scans since then
  std::optional<ScanOdometry> scanOdometry_;  ///< while the odometry stands still or is stuck
};

}  // namespace hybrid_slam
