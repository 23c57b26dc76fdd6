/// @file TrajectoryRecorder.h
/// @brief A pose for every scan, also for those between two updates of the filter.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <vector>

#include "files/Trajectory.h"

namespace hybrid_slam::run {

/// Remembers of each scan its time, its odometry and whether the filter ran.
class TrajectoryRecorder {
 public:
  /// @param motion   odometry since the scan before (m, rad)
  /// @param updates  the filter's number of updates after this scan
  void add(double timestamp, const mrpt::math::TPose2D& motion, size_t updates);

  /// The pose of every scan: of an update, the filter's own; between two, carried along the odometry from the
  /// update before, the closing error spread evenly over the scans up to the next; after the last, and before
  /// the first, carried along the odometry alone.
  /// @param path  one pose for each update (map frame)
  files::Trajectory trajectory(const std::vector<mrpt::math::TPose2D>& path) const;

  double distance() const { return distance_; }  ///< m, along the odometry

 private:
  struct Scan {
    double timestamp;
    mrpt::math::TPose2D odometry;
    size_t updates;
  };
  std::vector<Scan> scans_;
  double distance_ = 0;
};

}  // namespace hybrid_slam::run
