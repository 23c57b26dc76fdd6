/// @file OdometryTimeOffset.h
/// @brief Estimates the offset between the clocks of a log's odometry and its scans.
#pragma once

#include <optional>
#include <vector>

#include "readings/ReadingAssembler.h"

namespace hybrid_slam::run {

/// The clocks of a laser and of a robot's base may differ. Where the robot turns, a scan is the previous one
/// shifted by some beams. These turns tell how much later or earlier the odometry turns.
class OdometryTimeOffset {
 public:
  /// Call it for each reading of a log.
  void add(const readings::Reading& reading);
  /// Returns what to add to the odometry's timestamps (s, -10 to 10, in steps of 0.05). Empty if that would
  /// make little difference, if the robot has turned too little, or if no offset fits both halves of the log.
  std::optional<double> seconds() const;

 private:
  struct Turn {
    double from, to;  ///< s
    double angle;     ///< rad, as the scans see it
  };
  /// Heading (rad, unwrapped) of the odometry at a time (s).
  double headingAt(double time) const;
  /// Returns for each offset the sum of the differences (rad) between a part of the turns and the odometry.
  std::vector<double> misfits(size_t begin, size_t end) const;

  std::vector<double> times_, headings_;  ///< of the readings, by time
  double heading_ = 0;                    ///< of the last reading
  Scans::value_type lastScan_;
  double lastTime_ = 0;      ///< s
  std::vector<Turn> turns_;  ///< between neighbouring scans
};

}  // namespace hybrid_slam::run
