/// @file OdometryTrack.h
/// @brief The latest odometry readings as a motion over time.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <deque>
#include <utility>

namespace hybrid_slam::readings {

/// Interpolates position and heading linearly.
mrpt::math::TPose2D interpolate(const mrpt::math::TPose2D& a, const mrpt::math::TPose2D& b, double share);

/// Assumes constant velocity between the readings, after the last one, and before the first one for as long
/// as from there to the second. Restarts where time steps back or readings are too far apart.
class OdometryTrack {
 public:
  /// @param maxGap  largest time (s) between readings
  explicit OdometryTrack(double maxGap) : maxGap_(maxGap) {}

  /// Adds a reading (s; m, rad). It replaces an earlier one of the same time.
  void add(double time, const mrpt::math::TPose2D& pose);
  /// Returns whether a time (s) lies between the readings.
  bool contains(double time) const {
    return !readings_.empty() && readings_.front().first <= time && time <= readings_.back().first;
  }
  /// Returns whether a time lies between the readings, or may do so once the next reading is added.
  bool mayReach(double time) const {
    return !readings_.empty() && readings_.front().first <= time && time - readings_.back().first <= maxGap_;
  }
  /// Returns the time (s) of the last reading. Requires at least one reading, as does `at`.
  double end() const { return readings_.back().first; }
  /// Returns the pose at a time (s).
  mrpt::math::TPose2D at(double time) const;

 private:
  using Reading = std::pair<double, mrpt::math::TPose2D>;

  double maxGap_;
  std::deque<Reading> readings_;  ///< by time
};

}  // namespace hybrid_slam::readings
