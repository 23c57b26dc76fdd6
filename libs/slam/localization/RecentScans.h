/// @file RecentScans.h
/// @brief The recent scans of a robot whose place in the map is unknown, and its motion between them.
#pragma once

#include <deque>
#include <vector>

#include "slam/filter/PreparedScan.h"
#include "slam/grid/ScanMatcher.h"

namespace hybrid_slam {

/// A scan and where it was taken.
struct RecentScan {
  mrpt::math::TPose2D pose;  ///< odometry, corrected by scan matching; frame of the oldest scan ever added
  PreparedScan scan;         ///< without the people who stand where the scans before saw free space
};

/// The last scans at least 0.5 m or 20 deg apart, oldest first.
///
/// Each is matched to a local map of the few previous scans, so that odometry errors in turns do not distort
/// the window. That map also shows which things move, wherever the robot is.
class RecentScans {
 public:
  /// @param most  remembers at most this number of scans
  explicit RecentScans(const FilterConfiguration& configuration, size_t most = 40);

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

  /// Joins some of the newest scans in the robot frame of the newest, each as another laser.
  ScanBeams joined() const;
  /// Returns their lines, in the same frame.
  std::vector<LineSegment> lines() const;
  /// Returns the end points of all scans in the robot frame of the newest (m), those of the newest first.
  std::vector<mrpt::math::TPoint2D> endPoints() const;

 private:
  mrpt::math::TPose2D matched(const mrpt::math::TPose2D& expected, const PreparedScan& scan,
                              const OccupancyGrid& local) const;
  OccupancyGrid localMap() const;
  std::vector<size_t> spread() const;

  ScanPreparation prepare_;
  GridOptions grid_;
  MotionModelOptions motion_;
  double minFit_;
  size_t most_;
  ScanMatcher matcher_;
  std::deque<RecentScan> scans_;
  mrpt::math::TPose2D since_;
};

}  // namespace hybrid_slam
