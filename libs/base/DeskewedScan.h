/// @file DeskewedScan.h
/// @brief A scan whose beams are corrected for the robot's motion during the laser's sweep.
#pragma once

#include <mrpt/math/TPose2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include <memory>
#include <vector>

namespace hybrid_slam {

/// A scan as it would have been if all beams had been measured at its timestamp: the beams end where they
/// did, seen from the sensor at that time. Free space is taken to start there too, not where the sensor was
/// at the beam's time.
///
/// The angles are exact only in `angles`. For MRPT's code, and in files, it is a CObservation2DRangeScan with
/// equal steps between the beams, whose aperture and sensor pose include the turn.
class DeskewedScan : public mrpt::obs::CObservation2DRangeScan {
 public:
  DeskewedScan() = default;
  explicit DeskewedScan(const mrpt::obs::CObservation2DRangeScan& scan) : CObservation2DRangeScan(scan) {}

  /// Angle of each beam (rad, as Beam::angle) by its index; empty: equal steps.
  std::vector<double> angles;
  /// The ranges as measured, m. They identify the log of a session; the corrected ranges of a log's last
  /// scans may still change with later odometry. Not kept in sessions.
  std::vector<float> measured;
};

/// @param motion  of the robot from the scan's timestamp to the time of each beam (m, rad)
std::shared_ptr<DeskewedScan> deskew(const mrpt::obs::CObservation2DRangeScan& scan,
                                     const std::vector<mrpt::math::TPose2D>& motion);

/// A copy that keeps the angles of a deskewed scan.
std::shared_ptr<mrpt::obs::CObservation2DRangeScan> copyOf(const mrpt::obs::CObservation2DRangeScan& scan);

}  // namespace hybrid_slam
