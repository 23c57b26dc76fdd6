/// @file Laser.h
/// @brief SICK laser scanners in a floor plan.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <functional>
#include <vector>

#include "base/Options.h"

namespace mrpt::obs {
class CObservation2DRangeScan;
}

namespace hybrid_slam {
class RandomStream;
}

namespace hybrid_slam::simulation {

class BuildingPlan;

/// The scanners that are simulated.
enum class LaserType { lms100, lms200 };

/// Data sheet values.
struct LaserSpec {
  /// A resolution and how fast the scanner is at it.
  struct Mode {
    double resolutionDeg;  ///< between beams
    double rate;           ///< scans/s, at most
  };
  const char* name;
  double apertureDeg;  ///< first to last beam
  std::vector<Mode> modes;
  double maxRange;     ///< m
  double sigma;        ///< m, standard deviation of a reading
  double readingStep;  ///< m, readings are rounded to this
  double divergence;   ///< rad, full angle of a beam, which hits both sides of an edge
};

/// Returns the data sheet of a scanner.
const LaserSpec& laserSpec(LaserType type);

/// INI section [laser].
struct LaserOptions : Options {
  LaserType sensor = LaserType::lms100;
  double resolutionDeg = 0.5;
  double rate = 5;      ///< Hz
  double scanTime = 0;  ///< s
  bool noise = true;
  bool mixedPixels = false;
  double x = 0.15, y = 0, yaw = 0;  ///< m, rad: on the robot
  void describe(OptionTable& table) override;
};

/// Measures the beams one after another, or all at the same time if the scan time is 0.
class Laser {
 public:
  /// @throws InputError for a resolution or rate the sensor does not support
  explicit Laser(const LaserOptions& options);

  size_t beamCount() const { return beamCount_; }
  /// The robot's pose (frame of the plan) after a time (s) since the first beam.
  using Motion = std::function<mrpt::math::TPose2D(double)>;
  /// Returns the scan of a moving robot, with label LASER, right to left, without timestamp. Beams without a
  /// return have the maximum range and are marked invalid.
  mrpt::obs::CObservation2DRangeScan scan(const BuildingPlan& plan, const Motion& motion,
                                          RandomStream& random) const;
  /// Returns the scan of a robot that stands still, in the same form.
  mrpt::obs::CObservation2DRangeScan scan(const BuildingPlan& plan, const mrpt::math::TPose2D& robotPose,
                                          RandomStream& random) const;

 private:
  double reading(const BuildingPlan& plan, const mrpt::math::TPoint2D& origin, double heading,
                 RandomStream& random) const;

  LaserOptions options_;
  LaserSpec spec_;
  size_t beamCount_ = 0;
};

}  // namespace hybrid_slam::simulation
