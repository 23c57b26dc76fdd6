/// @file BeamFan.h
/// @brief Directions of an MRPT scan's beams, as seen from above.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <vector>

namespace mrpt::obs {
class CObservation2DRangeScan;
}

namespace hybrid_slam {

/// The fan of a sensor that is upright or upside down. It must not outlive the scan.
class BeamFan {
 public:
  explicit BeamFan(const mrpt::obs::CObservation2DRangeScan& scan);

  size_t beams() const { return beams_; }
  /// Pose of the sensor in the robot frame (m, rad). The heading is that of the sensor's x axis, which stays
  /// in the plane even if the sensor is upside down.
  const mrpt::math::TPose2D& sensorPose() const { return sensorPose_; }
  /// Returns whether angles decrease with the beam's index.
  bool isReversed() const { return isReversed_; }
  /// Angle (rad) of the beam with this index, relative to the sensor's heading, counter-clockwise.
  double angle(size_t beam) const {
    if (angles_) return (*angles_)[beam];
    const double rise = -0.5 * aperture_ + static_cast<double>(beam) * step_;
    return beams_ == 1 ? 0 : (isReversed_ ? -rise : rise);
  }

 private:
  size_t beams_;
  mrpt::math::TPose2D sensorPose_;
  bool isReversed_;
  double aperture_, step_;                       ///< rad
  const std::vector<double>* angles_ = nullptr;  ///< of a deskewed scan
};

}  // namespace hybrid_slam
