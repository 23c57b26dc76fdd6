/// @file TestRoomGrid.h
/// @brief For the tests: a simulated room or corridor, its map, and scans of it.
#pragma once

#include <mrpt/core/bits_math.h>
#include <mrpt/math/TPose2D.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/RandomStream.h"
#include "slam/grid/OccupancyGrid.h"

namespace hybrid_slam::test {

/// A rectangle of walls in the map frame, m; the robot is inside.
struct Box {
  double minX, minY, maxX, maxY;
};

inline constexpr Box kRoom{-3, -2.5, 5, 3.5};
inline constexpr Box kCorridor{-1000, -1.2, 1000, 1.2};  ///< its ends are out of range
inline constexpr Box kPillar{2, 0.5, 2.6, 1.2};          ///< breaks the room's symmetry

/// Distance from the robot to the walls or the pillar.
inline double castRay(const Box& room, double x, double y, double heading) {
  const double dx = std::cos(heading), dy = std::sin(heading);
  const auto reach = [](double from, double low, double high, double direction) {
    return direction == 0 ? 1e9 : ((direction > 0 ? high : low) - from) / direction;
  };
  double range = std::min(reach(x, room.minX, room.maxX, dx), reach(y, room.minY, room.maxY, dy));
  if (room.minX != kRoom.minX) return range;
  const double inX = reach(x, kPillar.maxX, kPillar.minX, dx), inY = reach(y, kPillar.maxY, kPillar.minY, dy);
  const double outX = reach(x, kPillar.minX, kPillar.maxX, dx),
               outY = reach(y, kPillar.minY, kPillar.maxY, dy);
  const double in = std::max(inX, inY);
  if (in > 0 && in < std::min(outX, outY)) range = std::min(range, in);
  return range;
}

/// A scan of 181 beams over 180 deg, 20 m, with 1 cm of noise, 0.2 m ahead of the robot's centre.
inline LaserScan scanAt(const Box& room, const mrpt::math::TPose2D& robot, RandomStream& random) {
  LaserScan scan;
  scan.sensorPose = {0.2, 0, 0};
  scan.maxRange = 20;
  const mrpt::math::TPose2D laser = robot + scan.sensorPose;
  for (int i = -90; i <= 90; ++i) {
    Beam beam;
    beam.angle = mrpt::DEG2RAD(1.0 * i);
    beam.range = castRay(room, laser.x, laser.y, laser.phi + beam.angle) + 0.01 * random.gaussian();
    beam.valid = beam.range < scan.maxRange;
    scan.beams.push_back(beam);
  }
  return scan;
}

inline ScanBeams beamsAt(const Box& room, const mrpt::math::TPose2D& robot, RandomStream& random) {
  return ScanBeams(scanAt(room, robot, random));
}

/// Map of 60 scans from all over the robot's area.
inline OccupancyGrid gridOf(const Box& room, uint64_t seed = 1) {
  RandomStream random(seed, 0, 0);
  OccupancyGrid grid(0.05);
  const auto within = [&](double low, double high) { return low + (high - low) * random.uniform(); };
  for (int i = 0; i < 60; ++i) {
    const mrpt::math::TPose2D robot(within(-1.5, 1.5), within(-0.8, 0.8), within(-M_PI, M_PI));
    grid.insert(beamsAt(room, robot, random), robot, GridOptions());
  }
  return grid;
}

}  // namespace hybrid_slam::test
