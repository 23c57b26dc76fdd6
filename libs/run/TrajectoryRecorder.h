/// @file TrajectoryRecorder.h
/// @brief Records a pose for every scan, also between two updates of the filter.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <vector>

#include "files/Trajectory.h"

namespace hybrid_slam::run {

/// Records each scan's time, odometry and whether it caused an update.
class TrajectoryRecorder {
 public:
  /// @param motion   odometry since the previous scan (m, rad)
  /// @param updates  number of filter updates after this scan
  void add(double timestamp, const mrpt::math::TPose2D& motion, size_t updates);

  /// Returns the pose of every scan: at an update, the filter's; between two, odometry from the previous
  /// update, with the closing error spread over the motion up to the next; before the first and after
  /// the last, odometry alone.
  /// @param path  one pose per update (map frame)
  files::Trajectory trajectory(const std::vector<mrpt::math::TPose2D>& path) const;

  /// Returns the odometry from each scan to the next (m, rad).
  std::vector<mrpt::math::TPose2D> motions() const;

  /// Returns the odometry of each update since the one before (m, rad); zero for the first.
  std::vector<mrpt::math::TPose2D> motionsOfUpdates() const;

  /// Returns the number of updates up to each scan.
  std::vector<size_t> updates() const;

  double distance() const { return distance_; }  ///< m, along the odometry

  template <class State>
  void visit(State& state) {
    state(scans_, distance_);
    size_t before = 0;
    for (const Scan& scan : scans_) {
      state.check(scan.updates == before || scan.updates == before + 1,
                  "the scans do not belong to the path");
      before = scan.updates;
    }
  }

 private:
  std::vector<size_t> scansOfUpdates() const;  ///< their indices

  struct Scan {
    double timestamp;
    mrpt::math::TPose2D odometry;
    size_t updates;

    template <class State>
    void visit(State& state) {
      state(timestamp, odometry, updates);
    }
  };
  std::vector<Scan> scans_;
  double distance_ = 0;
};

}  // namespace hybrid_slam::run
