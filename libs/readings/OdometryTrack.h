/// @file OdometryTrack.h
/// @brief The latest odometry readings as a motion over time.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <deque>
#include <utility>

namespace hybrid_slam::readings {

/// Linear in position and heading.
mrpt::math::TPose2D interpolate(const mrpt::math::TPose2D& a, const mrpt::math::TPose2D& b, double share);

/// Constant velocity between the readings, and after the last one. Starts again where time steps back or
/// readings are too far apart.
class OdometryTrack {
 public:
  /// @param maxGap  s, between readings
  explicit OdometryTrack(double maxGap) : maxGap_(maxGap) {}

  /// A reading (s; m, rad). The latest of one time counts.
  void add(double time, const mrpt::math::TPose2D& pose);
  /// Whether a time (s) lies between the readings.
  bool contains(double time) const {
    return !readings_.empty() && readings_.front().first <= time && time <= readings_.back().first;
  }
  /// Likewise, or whether the next reading may come after it.
  bool mayReach(double time) const {
    return !readings_.empty() && readings_.front().first <= time && time - readings_.back().first <= maxGap_;
  }
  /// s; of the last reading. At least one is needed, as for the pose.
  double end() const { return readings_.back().first; }
  /// The pose at a time (s). Up to the first reading it is that of the first reading.
  mrpt::math::TPose2D at(double time) const;

 private:
  using Reading = std::pair<double, mrpt::math::TPose2D>;

  double maxGap_;
  std::deque<Reading> readings_;  ///< by time
};

}  // namespace hybrid_slam::readings
