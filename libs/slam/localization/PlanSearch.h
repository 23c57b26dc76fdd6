/// @file PlanSearch.h
/// @brief Finds the robot in a floor plan of unknown scale.
#pragma once

#include <tbb/task_arena.h>

#include <optional>
#include <vector>

#include "slam/filter/MapMaker.h"
#include "slam/grid/GlobalSearch.h"
#include "slam/lines/LineDatabase.h"
#include "slam/localization/PlanFit.h"
#include "slam/localization/RecentScans.h"
#include "slam/plan/PlanLine.h"

namespace hybrid_slam {

/// Searches the plan for the end points of the recent scans and fits pose and scale at the best places
/// (PlanFit.h). The robot is where most points lie on walls of the plan, if there are clearly fewer at every
/// other place. Points without a wall, and walls that the scans contradict, do not rule a place out: a plan
/// may be wrong in parts.
class PlanSearch {
 public:
  /// @param start  pose of the robot (m, rad; frame of the plan) at the first scan, right within 0.5 m and
  ///               15 deg; the first scan of which 65 % of the points lie on walls there is fitted; empty:
  ///               anywhere
  /// @throws InputError for a plan without walls of 1 m, with walls over 1 km from its origin or of more than
  ///         2^23 cells (2^25 with a start), and for MRPT's auxiliary filters
  PlanSearch(const FilterConfiguration& configuration, std::vector<PlanLine> walls,
             std::optional<mrpt::math::TPose2D> start);

  /// Searches with the first 240 scans that are 0.5 m or 20 deg apart.
  void process(const mrpt::math::TPose2D& odometry, const Scans& scans);

  /// The robot in the plan.
  struct Found {
    double scale;              ///< of the plan
    mrpt::math::TPose2D pose;  ///< current pose of the robot, in the scaled plan
    ScanMap map;               ///< no cells, and the scaled plan's lines as if each had been seen three times
  };
  /// Set once the robot has been found.
  const std::optional<Found>& found() const { return found_; }
  /// Returns whether the robot has been found or the last scan of the search has passed. Further scans have
  /// no effect.
  bool isOver() const;

 private:
  struct ScaledPlan {
    double scale;
    GlobalSearch search;
  };
  std::optional<PlanFit> fitAnywhere();
  PlanFit fitAtStart() const;
  void accept(const PlanFit& fit);

  double cell_;  ///< m
  LineDatabaseOptions database_;
  std::vector<PlanLine> walls_;
  std::optional<mrpt::math::TPose2D> start_;  ///< moved by the odometry
  OccupancyGrid grid_;                        ///< of the plan as drawn; with a start
  LineDatabase lines_;                        ///< of the plan as drawn; without
  std::vector<ScaledPlan> plans_;             ///< without
  ScanPreparation prepare_;
  RecentScans recent_;
  tbb::task_arena arena_;
  mrpt::math::TPose2D odometry_;  ///< since the last scan
  size_t added_ = 0;              ///< scans
  std::optional<PlanFit> last_;   ///< of the last search, if its best place was clear
  mrpt::math::TPose2D at_;        ///< of the robot then, frame of the recent scans
  std::optional<Found> found_;
};

}  // namespace hybrid_slam
