/// @file PlaceSearch.h
/// @brief Finds the robot in the map that a run continues, or in a floor plan.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "readings/ReadingAssembler.h"
#include "run/Configuration.h"
#include "slam/filter/HybridFilter.h"
#include "slam/localization/Localizer.h"
#include "slam/localization/PlanSearch.h"

namespace hybrid_slam::run {

/// The place of the robot in the map of an earlier run or in a floor plan.
struct FoundPlace {
  ScanMap map;
  mrpt::math::TPose2D pose;  ///< current, m, rad, in the map
  std::string note;          ///< one line: when and where it was found
};

/// Searches while the filter maps in a separate frame.
class PlaceSearch {
 public:
  /// @param configuration  must outlive it
  /// @param earlierMap     of the run to continue; empty: the floor plan of `configuration` is searched
  /// @throws InputError for settings that a filter rejects, and for a plan that cannot be searched
  PlaceSearch(const Configuration& configuration, std::optional<ScanMap> earlierMap);

  /// Takes a reading that `filter` has just processed.
  /// @param scans  number of readings so far, this one included
  /// @return the place, once it has been found
  std::optional<FoundPlace> process(const readings::Reading& reading, const HybridFilter& filter,
                                    size_t scans);
  /// Returns whether the place has been found, or the search given up.
  bool isOver() const { return isOver_; }
  /// Returns the search in the earlier map; null for a floor plan.
  const FilterView* view() const { return localizer_.get(); }
  /// Says in one line if the found place is not checked; else empty.
  std::string warning() const;

 private:
  std::optional<FoundPlace> findInMap(const readings::Reading& reading, const HybridFilter& filter,
                                      size_t scans);
  std::optional<FoundPlace> findInPlan(const readings::Reading& reading, size_t scans);
  bool isContradictedAt(const mrpt::math::TPose2D& pose, const HybridFilter& filter);

  const RunOptions& run_;
  std::optional<ScanMap> earlierMap_;
  std::unique_ptr<Localizer> localizer_;  ///< in this map
  std::optional<OccupancyGrid> walls_;    ///< of this map, to compare scans with
  size_t nextPlace_ = 0;                  ///< scan from which a place may be accepted
  std::unique_ptr<PlanSearch> plan_;
  bool isOver_ = false;
};

}  // namespace hybrid_slam::run
