/// @file FrozenLasers.h
/// @brief Recognises a laser that repeats its last scan while the robot moves.
#pragma once

#include <mrpt/math/TPose2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include <map>
#include <string>

namespace hybrid_slam::readings {

/// Some drivers repeat the last scan bit by bit when they lose the laser. A simulation without noise gives
/// equal scans, too, and rightly so: of a robot that stands while its odometry drifts, and along straight
/// walls that end out of sight. There, the odometry moves the scan's points along the walls that they show.
class FrozenLasers {
 public:
  /// Call it for each scan of the log, with invalid beams marked.
  /// @param odometry  at the scan's time
  /// @return whether the scan is an old one: at least 10 returns, equal to those of the laser's last scan
  ///         although the robot has moved
  bool isFrozen(const mrpt::obs::CObservation2DRangeScan::Ptr& scan, const mrpt::math::TPose2D& odometry);

 private:
  struct Seen {
    mrpt::obs::CObservation2DRangeScan::Ptr scan;
    mrpt::math::TPose2D odometry;
  };
  std::map<std::string, Seen> newest_;  ///< of each laser: the last scan that was not frozen and that differs
};

}  // namespace hybrid_slam::readings
