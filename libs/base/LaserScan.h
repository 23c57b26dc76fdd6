/// @file LaserScan.h
/// @brief Planar scans as the project uses them: a validity flag for each beam, angles as seen from above.
#pragma once

#include <mrpt/core/Clock.h>
#include <mrpt/math/TPose2D.h>

#include <memory>
#include <vector>

namespace mrpt::obs {
class CObservation2DRangeScan;
}

namespace hybrid_slam {

/// One beam in the sensor frame (x forwards, angles counter-clockwise seen from above).
struct Beam {
  double angle = 0;    ///< rad
  double range = 0;    ///< m; meaningless unless valid
  bool valid = false;  ///< finite, positive, below the maximum range, and marked valid by the sensor
};

/// The beams of one planar scan by ascending angle, and the sensor pose on the robot. The beams of a deskewed
/// scan keep the order of the sweep, so the angles of neighbours may be swapped.
///
/// Scans of a laser mounted upside down, or with clockwise beams (`rightToLeft == false`), are already
/// mirrored.
struct LaserScan {
  mrpt::Clock::time_point timestamp;
  mrpt::math::TPose2D sensorPose;  ///< in the robot frame (m, rad)
  double maxRange = 0;             ///< m; readings at or beyond it are invalid
  std::vector<Beam> beams;
};

/// The scans of a robot's lasers at one time.
using LaserScans = std::vector<LaserScan>;
constexpr size_t kMaxLasers = 8;
/// Largest number of beams of a scan: more than any laser has, few enough for line extraction.
constexpr size_t kMostScanBeams = 10000;
/// Largest distance (m) of a sensor from the robot's centre; a larger one is taken for an error.
constexpr double kMaxSensorDistance = 100;

/// The scans of a robot's lasers as MRPT observations, as logs and robots provide them. Sensor poses are
/// relative to the robot pose of the latest scan.
using Scans = std::vector<std::shared_ptr<mrpt::obs::CObservation2DRangeScan>>;

/// Keeps every n-th beam of a scan with more than kMostScanBeams beams, with the smallest n that suffices.
/// @param maxRange  m, above 0; the smaller of this and the observation's own limit (<= 0: none) applies
/// @throws InputError for a scan plane tilted by more than 5 deg from the horizontal
LaserScan toLaserScan(const mrpt::obs::CObservation2DRangeScan& observation, double maxRange);
/// Converts each scan. @throws InputError for a tilted scan plane, and for more than kMaxLasers scans
LaserScans toLaserScans(const Scans& scans, double maxRange);

/// Returns whether a laser is mounted in the plane of the map, upright or upside down, within 5 deg.
bool isHorizontal(const mrpt::obs::CObservation2DRangeScan& observation);

}  // namespace hybrid_slam
