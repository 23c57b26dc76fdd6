/// @file RobotParts.h
/// @brief Finds the beams of a laser that end at the robot itself.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "readings/ReadingAssembler.h"

namespace hybrid_slam::run {

/// Beams that measure the same short range wherever a robot goes end at its own parts, such as posts around
/// the laser.
class RobotParts {
 public:
  /// Call it for each reading of a log.
  void add(const readings::Reading& reading);
  /// Returns the longest range that at least three beams of one laser measure at the robot (m), below 0.4 m;
  /// 0 if there are none, or if the robot has driven less than 3 m or turned less than 90 deg.
  double farthest() const;

 private:
  mrpt::math::TPose2D moved_;    ///< since the last reading that counts
  double way_ = 0, turned_ = 0;  ///< m, rad, in both directions
  struct Laser {
    size_t scans = 0;
    std::vector<std::vector<float>> ranges;  ///< m, of each beam
  };
  std::map<std::string, Laser> lasers_;  ///< by label
};

}  // namespace hybrid_slam::run
