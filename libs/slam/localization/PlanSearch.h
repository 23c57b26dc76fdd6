/// @file PlanSearch.h
/// @brief Finds the robot in a floor plan of unknown scale.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "slam/filter/Refinement.h"
#include "slam/localization/Localizer.h"
#include "slam/plan/PlanLine.h"

namespace hybrid_slam {

/// A localiser for each scale from 0.97 to 1.03, in a grid of the plan in which everything but walls is free.
/// Several may find the robot; where one does, the recent scans are fitted to the plan, which gives the scale
/// (PlanFit.h).
class PlanSearch {
 public:
  /// @param start  pose of the robot (m, rad; frame of the plan), right within 0.5 m and 15 deg; the scale is
  ///               then fitted from 1; empty: anywhere
  /// @throws InputError for a plan without walls of 1 m or of more than 2^25 cells, and for settings that
  ///         Localizer rejects
  PlanSearch(const FilterConfiguration& configuration, std::vector<PlanLine> walls,
             std::optional<mrpt::math::TPose2D> start);

  /// Searches with the first 100 scans.
  void process(const mrpt::math::TPose2D& odometry, const Scans& scans);

  struct Found {
    double scale;              ///< of the plan
    mrpt::math::TPose2D pose;  ///< of the robot now, in the scaled plan
    ScanMap map;               ///< no cells, and the scaled plan's lines as if each had been seen three times
  };
  /// Set once the robot has been found; of several scales the one nearest to 1.
  const std::optional<Found>& found() const { return found_; }
  /// Whether the robot has been found or the last scan of the search has passed. Further scans change
  /// nothing.
  bool isOver() const;

 private:
  struct Candidate {
    double scale;
    std::unique_ptr<Localizer> localizer;
  };
  double cell_, directionWindow_;  ///< m, rad
  std::vector<PlanLine> walls_;
  std::vector<Candidate> candidates_;
  std::optional<Found> found_;
  size_t scans_ = 0;
};

}  // namespace hybrid_slam
