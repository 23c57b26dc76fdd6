/// @file BuildingPlan.h
/// @brief A building's walls, with ray casting and distance queries.
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <optional>
#include <string>
#include <vector>

#include "study/simulation/WallIndex.h"

namespace hybrid_slam::simulation {

/// Walls in one plane (m), read from a text file (format: doc/simulation.md).
class BuildingPlan {
 public:
  explicit BuildingPlan(std::vector<Wall> walls) : index_(std::move(walls)) {}
  /// @throws InputError naming file and line: unreadable file, unknown word, wrong number of values,
  ///         zero-length wall, unclosed polygon, door not on a wall, no walls
  static BuildingPlan load(const std::string& file);

  /// Returns this plan with additional walls.
  BuildingPlan with(const std::vector<Wall>& more) const;

  const std::vector<Wall>& walls() const { return index_.walls(); }
  /// Distance (m) to the first wall from `origin` towards `heading` (rad); empty beyond maxRange.
  std::optional<double> castRay(const mrpt::math::TPoint2D& origin, double heading, double maxRange) const;
  /// m; infinity for a plan without walls
  double distanceToNearestWall(const mrpt::math::TPoint2D& p) const { return index_.nearestDistance(p); }
  /// Corners of the walls' bounding box (m); arcs count as full circles.
  const mrpt::math::TPoint2D& lowerLeft() const { return index_.low(); }
  const mrpt::math::TPoint2D& upperRight() const { return index_.high(); }

 private:
  WallIndex index_;
};

}  // namespace hybrid_slam::simulation
