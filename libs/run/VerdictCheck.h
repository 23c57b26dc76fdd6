/// @file VerdictCheck.h
/// @brief Chooses the scans that a verdict compares, and collects their evidence.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "base/LaserScan.h"
#include "run/Verdict.h"
#include "slam/filter/FilterView.h"

namespace hybrid_slam::run {

/// m of path: the scans before are the map from just before.
constexpr double kRecent = 2;

/// Chooses the scans to compare along a path: one every 0.5 m or 30 deg.
class ComparisonSteps {
 public:
  bool isDue(const mrpt::math::TPose2D& pose);

 private:
  std::optional<mrpt::math::TPose2D> last_;
};

/// The map of an earlier run as RevisitCheck takes it. Larger cells blur the walls: their map becomes empty,
/// so that nothing is compared with it.
OccupancyGrid toCompare(const OccupancyGrid& map);

/// Compares the scans of a path with the maps of the scans before them, and with that of an earlier run.
class ScanComparisons {
 public:
  /// @param earlier  as `toCompare` makes it
  void compareWith(const OccupancyGrid& earlier) { earlier_.emplace(earlier); }
  /// @param distance  m, along the path
  void add(const mrpt::math::TPose2D& pose, const ScanBeams& beams, double distance, size_t update);
  Evidence evidence() const;

 private:
  RevisitCheck returning_{RevisitCheck::kReturn}, recent_{kRecent};
  std::optional<RevisitCheck> earlier_;
};

/// Collects the evidence of the scans along the final path.
class VerdictCheck {
 public:
  /// @param maxRange  m, of the beams that the map uses
  /// @param earlier   map that the run continues, or null
  explicit VerdictCheck(double maxRange, const OccupancyGrid* earlier = nullptr)
      : maxRange_(maxRange), lasers_(RevisitCheck::rangeOf(maxRange)) {
    if (earlier) comparisons_.compareWith(toCompare(*earlier));
  }

  /// Call it for each reading, before `add`. @param way  m, along the odometry, since the reading before
  /// @param hasScans  that the filter has taken
  void addWay(double way, bool hasScans);
  /// @param pose  of the next update, map frame; @param scans  of it
  void add(const mrpt::math::TPose2D& pose, const Scans& scans);
  Evidence evidence() const;

 private:
  double maxRange_;
  ScanComparisons comparisons_;
  LaserAgreement lasers_;
  ComparisonSteps steps_;
  std::optional<mrpt::math::TPose2D> last_;
  double distance_ = 0;
  size_t updates_ = 0;
  double way_ = 0;  ///< m, along the odometry, since the last scan
  Gap gap_;         ///< the longest
};

/// The scans to compare in an ongoing run, whose path may still change: about 2 kB per metre of path. Copies
/// share them.
class ComparedScans {
 public:
  /// @param maxRange  m, of the beams that the map uses
  explicit ComparedScans(double maxRange) : maxRange_(maxRange) {}

  /// @param pose    of the best particle at an update, map frame
  /// @param update  index of the path
  void add(const mrpt::math::TPose2D& pose, size_t update, const Scans& scans);
  /// @param path     a pose for each update, map frame
  /// @param earlier  of the map that the run continues, as `toCompare` makes it, or null
  Evidence evidence(const std::vector<mrpt::math::TPose2D>& path,
                    const OccupancyGrid* earlier = nullptr) const;

 private:
  struct Beam {
    float direction, range;  ///< rad, robot frame; m
    uint32_t laser;          ///< index in `origins`
  };
  struct Scan {
    size_t update;
    std::vector<mrpt::math::TPoint2D> origins;  ///< of each laser, robot frame, m
    std::vector<Beam> beams;
  };
  double maxRange_;
  std::vector<std::shared_ptr<const Scan>> scans_;
  ComparisonSteps steps_;
};

/// The verdict on the map of an ongoing run.
class RunningVerdict {
 public:
  /// @param maxRange  m, of the beams that the map uses
  explicit RunningVerdict(double maxRange) : scans_(maxRange) {}

  /// Call it after each update of a filter that maps. @param scans  of the update
  void add(const FilterView& view, const Scans& scans);
  /// Returns a function that judges the current map. Any thread may call it; it takes 30 ms to 70 ms per km
  /// of path.
  std::function<Verdict()> judge(const FilterView& view) const;

 private:
  ComparedScans scans_;
  std::shared_ptr<const OccupancyGrid> earlier_;  ///< of the map that the run continues
  size_t slips_ = 0;                              ///< updates whose odometry was rejected
};

}  // namespace hybrid_slam::run
