/// @file RecentScans.h
/// @brief The last scans of a robot whose place in the map is unknown, and its motion between them.
#pragma once

#include <deque>
#include <vector>

#include "slam/filter/PreparedScan.h"
#include "slam/grid/ScanMatcher.h"

namespace hybrid_slam {

struct RecentScan {
  mrpt::math::TPose2D pose;  ///< odometry, corrected by scan matching; frame of the oldest scan ever added
  PreparedScan scan;
};

/// Scans at least 0.5 m or 20 deg apart, oldest first; the last 40.
///
/// Each is matched to a local map of the few before it, so that errors of the odometry in turns do not bend
/// the window.
class RecentScans {
 public:
  explicit RecentScans(const FilterConfiguration& configuration);

  /// @param odometry  since the previous call (m, rad)
  /// @return whether the scan was far enough from the last one to be added
  bool add(const mrpt::math::TPose2D& odometry, const PreparedScan& scan);
  /// Forgets all but the newest `count` scans.
  void keep(size_t count);

  const std::deque<RecentScan>& scans() const { return scans_; }
  /// Motion (m, rad) from a scan to another, in the frame of the first.
  mrpt::math::TPose2D motion(size_t from, size_t to) const { return scans_[to].pose - scans_[from].pose; }
  /// Odometry since the newest scan.
  const mrpt::math::TPose2D& since() const { return since_; }

  /// Some of the newest scans as one, in the robot frame of the newest, each of them another laser of it.
  ScanBeams joined() const;
  /// Their lines, in the same frame.
  std::vector<LineSegment> lines() const;

 private:
  mrpt::math::TPose2D matched(const mrpt::math::TPose2D& expected, const PreparedScan& scan) const;
  std::vector<size_t> spread() const;

  GridOptions grid_;
  MotionModelOptions motion_;
  double minFit_;
  ScanMatcher matcher_;
  std::deque<RecentScan> scans_;
  mrpt::math::TPose2D since_;
};

}  // namespace hybrid_slam
