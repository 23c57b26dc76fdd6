/// @file GlobalLocalization.h
/// @brief Finds a robot of unknown pose in a fixed map.
#pragma once

#include <tbb/task_arena.h>

#include <vector>

#include "base/Degree.h"
#include "slam/filter/FilterView.h"
#include "slam/grid/CorrelativeSearch.h"
#include "slam/grid/GlobalSearch.h"
#include "slam/grid/GridWeight.h"
#include "slam/grid/ScanMatcher.h"
#include "slam/lines/LineDatabase.h"
#include "slam/localization/RecentScans.h"

namespace hybrid_slam {

/// Searched around a given start.
inline constexpr SearchWindow kStartWindow{0.5, 15 * kDegree};

/// Agreement of a scan with the map at a pose.
struct ScanEvidence {
  double logGrid = 0;  ///< ln w_grid before tempering
  BeamShares shares;
};

/// Returns whether most of the beams end at walls of the map and few contradict it.
bool isExplained(const BeamShares& scan);

/// A place where the robot may be.
struct Hypothesis {
  mrpt::math::TPose2D pose;            ///< of the robot at the newest scan, map frame
  std::vector<ScanEvidence> evidence;  ///< of each remembered scan, oldest first
  double logWeight = 0;                ///< ln of the tempered weight by all remembered scans
};

/// Hypotheses over the whole map, each followed by scan matching and weighed by the same window of scans.
///
/// The scans of the window are searched for together in the whole map. Each place found is a new hypothesis;
/// the older scans are matched one by one backwards along the odometry, so that it is comparable with those
/// followed so far. The robot is found when one place explains the scans and no other does nearly as well.
class GlobalLocalization {
 public:
  GlobalLocalization(const GridWeightOptions& gridWeight, const ScanMatcherOptions& matcher,
                     OccupancyGrid grid, LineDatabase lines);

  /// Forgets the hypotheses.
  void clear() { hypotheses_.clear(), isFound_ = false; }
  /// Uses the newest of the recent scans. Call it for each scan added.
  void update(const RecentScans& recent, tbb::task_arena& arena);
  /// Returns whether one place explains the scans and no other does nearly as well.
  bool isFound() const { return isFound_; }
  /// Returns whether another place explains the recent scans much better than the robot at `pose`.
  bool refutes(const mrpt::math::TPose2D& pose, const RecentScans& recent) const;
  /// The hypotheses, best first.
  const std::vector<Hypothesis>& hypotheses() const { return hypotheses_; }
  /// The belief: the hypotheses, and places all over the map in case none of them is right.
  /// @param since  motion since the newest scan
  std::vector<WeightedPose> poses(const mrpt::math::TPose2D& since) const;

  /// The hypothesis near `pose` that fits the recent scans best.
  Hypothesis near(const mrpt::math::TPose2D& pose, const SearchWindow& window,
                  const RecentScans& recent) const;

 private:
  ScanEvidence match(const PreparedScan& scan, mrpt::math::TPose2D& pose) const;
  void follow(Hypothesis& hypothesis, const RecentScans& recent) const;
  Hypothesis judged(const mrpt::math::TPose2D& pose, const RecentScans& recent) const;
  void weigh(Hypothesis& hypothesis) const;
  bool decide() const;
  /// Log-weight of this number of scans at a place outside the map.
  double unexplained(size_t scans) const;

  OccupancyGrid grid_;
  LineDatabase lines_;
  double exponent_;
  ScanMatcher matcher_;
  GridWeight gridWeight_;
  GlobalSearch search_;
  std::vector<WeightedPose> anywhere_;
  std::vector<Hypothesis> hypotheses_;
  bool isFound_ = false;
};

}  // namespace hybrid_slam
