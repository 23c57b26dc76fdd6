/// @file ScanBeams.h
/// @brief A scan prepared once for all particles: where each beam starts and which way it points.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <cmath>
#include <vector>

#include "base/LaserScan.h"

namespace hybrid_slam {

/// The valid beams of one scan in the robot frame; no trigonometry is left to do for a particle but that of
/// its own heading.
struct ScanBeams {
  struct Ray {
    double dirX, dirY;  ///< unit vector, robot frame
    double range;       ///< m
  };
  double originX = 0, originY = 0;  ///< the sensor, robot frame, m
  std::vector<Ray> rays;

  /// All beams.
  explicit ScanBeams(const LaserScan& scan) : originX(scan.sensorPose.x), originY(scan.sensorPose.y) {
    for (const Beam& beam : scan.beams)
      if (beam.valid) add(scan, beam);
  }
  /// Those taken by a BeamSelection.
  ScanBeams(const LaserScan& scan, const std::vector<size_t>& taken)
      : originX(scan.sensorPose.x), originY(scan.sensorPose.y) {
    rays.reserve(taken.size());
    for (const size_t i : taken) add(scan, scan.beams[i]);
  }

 private:
  void add(const LaserScan& scan, const Beam& beam) {
    const double heading = scan.sensorPose.phi + beam.angle;
    rays.push_back({std::cos(heading), std::sin(heading), beam.range});
  }
};

/// Robot poses in units of cells, with the sine and cosine taken once.
struct GridPose {
  GridPose(const mrpt::math::TPose2D& robot, const ScanBeams& scan, double cellSize)
      : cosPhi(std::cos(robot.phi)),
        sinPhi(std::sin(robot.phi)),
        originX((robot.x + cosPhi * scan.originX - sinPhi * scan.originY) / cellSize),
        originY((robot.y + sinPhi * scan.originX + cosPhi * scan.originY) / cellSize) {}
  double dirX(const ScanBeams::Ray& ray) const { return cosPhi * ray.dirX - sinPhi * ray.dirY; }
  double dirY(const ScanBeams::Ray& ray) const { return sinPhi * ray.dirX + cosPhi * ray.dirY; }

  double cosPhi, sinPhi;
  double originX, originY;  ///< the sensor in the map frame, in cells
};

}  // namespace hybrid_slam
