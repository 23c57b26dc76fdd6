/// @file RevisitCheck.h
/// @brief Checks whether scans contradict the map made earlier along the same path.
#pragma once

#include <algorithm>
#include <deque>
#include <vector>

#include "slam/grid/OccupancyGrid.h"

namespace hybrid_slam {

/// A scan of places mapped before.
struct Revisit {
  mrpt::math::TPose2D pose;  ///< of the robot, map frame
  size_t update = 0;         ///< index of the scan on the path
  double distance = 0;       ///< m, along the path
  size_t compared = 0;       ///< beams that cross a wall of the earlier map, or end at one or in free space
  size_t contradicted = 0;   ///< of these, beams that cross a wall or end in free space
  size_t narrow = 0;  ///< of these, beams that end in free space at a narrow thing, which may have moved
  /// Share of the compared beams that contradict the map; NaN without any.
  double share() const { return static_cast<double>(contradicted) / static_cast<double>(compared); }
  bool isContradicted() const { return share() > 0.2; }

  static constexpr size_t kFewest = 8;  ///< beams compared
};

/// Compares each scan of a path with the map of the scans taken at least `delay` (m of path) earlier. People
/// and doors contradict with some beams; a doubled wall or a room on top of another one contradicts with
/// most.
///
/// The cells are 0.1 m wide, so a wall may be off by 0.1 m to 0.2 m.
class RevisitCheck {
 public:
  /// @param delay  m of path
  explicit RevisitCheck(double delay) : delay_(delay), grid_(kResolution) {}
  /// Compares each scan with `map` alone, the map of an earlier run.
  /// @param map  with cells of kResolution
  explicit RevisitCheck(const OccupancyGrid& map);

  /// Adds the next scan of the path.
  /// @param distance  m, along the path
  void add(const mrpt::math::TPose2D& pose, const ScanBeams& beams, double distance, size_t update);
  /// The scans with at least 8 and at least 10 % of their beams compared.
  const std::vector<Revisit>& revisits() const { return revisits_; }
  /// Mean number of beams of all scans added; NaN before the first.
  double meanBeams() const { return static_cast<double>(beams_) / static_cast<double>(scans_); }

  static constexpr double kReturn = 20;       ///< m of path after which a scan returns
  static constexpr double kResolution = 0.1;  ///< m
  /// The longest beam to compare, m: 8 m in buildings, more where the map uses beams of over 20 m.
  static double rangeOf(double maxRange) { return std::min(maxRange, std::max(8.0, 0.4 * maxRange)); }

 private:
  struct Waiting {
    mrpt::math::TPose2D pose;
    ScanBeams beams;
    double distance;
  };
  double delay_;
  OccupancyGrid grid_;
  std::deque<Waiting> waiting_;  ///< not yet in the map
  std::vector<Revisit> revisits_;
  size_t scans_ = 0, beams_ = 0;
};

/// The scans without their beams at narrow things (NarrowThings.h). A scan with fewer than 8 beams left
/// contradicts nothing.
std::vector<Revisit> withoutNarrowThings(std::vector<Revisit> revisits);

/// Number of the scans that contradict the map.
size_t contradictedOf(const std::vector<Revisit>& revisits);

/// Share of the compared beams that contradict the map; 0 without any.
double contradictionOf(const std::vector<Revisit>& revisits);

/// Whether a correction of the path makes its scans contradict the map more. The share of the contradicting
/// beams must grow over all returning scans, and by more than 0.35 percentage points over those that returned
/// both before and after it (at least 20). So a correction may move scans from unknown space to a place with
/// people, and may cost old scans a little if it gains more at the newest.
bool isMoreContradicted(const std::vector<Revisit>& before, const std::vector<Revisit>& after);

/// Share of the compared beams of a path that contradict the map from 20 m of path before; 0 without any.
/// @param path      a pose for each update, map frame
/// @param scans     of each update; those of the last ones may be missing
/// @param maxRange  m, of the beams that the map uses
double contradictionOf(const std::vector<mrpt::math::TPose2D>& path, const std::vector<Scans>& scans,
                       double maxRange);

/// Selects at most 90 beams.
ScanBeams beamsToCompare(const LaserScans& scans);
/// Selects at most 90 beams of up to `RevisitCheck::rangeOf(maxRange)`.
/// @param maxRange  m, of the beams that the map uses: longer ones may have no return
ScanBeams beamsToCompare(const Scans& scans, double maxRange);

}  // namespace hybrid_slam
