/// @file ScanBeams.h
/// @brief A scan prepared once for all particles: where each beam starts and which way it points.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/LaserScan.h"

namespace hybrid_slam {

/// Every so many-th of `count` beams leaves about `beams`, evenly spread; 0 leaves all.
inline size_t beamStep(size_t count, int beams) {
  if (beams == 0) return 1;
  return std::max<size_t>(1, (2 * count + static_cast<size_t>(beams)) / (2 * static_cast<size_t>(beams)));
}

/// The valid beams of one scan in the robot frame; no trigonometry is left to do for a particle but that of
/// its own heading.
struct ScanBeams {
  struct Ray {
    double dirX, dirY;  ///< unit vector, robot frame
    double range;       ///< m
  };
  double originX = 0, originY = 0;  ///< the sensor, robot frame, m
  std::vector<Ray> rays;

  /// @param beams  of those of the scan, valid or not, takes about so many; 0: all
  explicit ScanBeams(const LaserScan& scan, int beams = 0)
      : originX(scan.sensorPose.x), originY(scan.sensorPose.y) {
    const size_t step = beamStep(scan.beams.size(), beams);
    for (size_t i = 0; i < scan.beams.size(); i += step) {
      const Beam& beam = scan.beams[i];
      const double heading = scan.sensorPose.phi + beam.angle;
      if (beam.valid) rays.push_back({std::cos(heading), std::sin(heading), beam.range});
    }
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
