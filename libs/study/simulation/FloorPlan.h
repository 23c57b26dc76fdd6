/// @file FloorPlan.h
/// @brief The building: walls, what a laser beam sees of them, and how near they are.
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <optional>
#include <string>
#include <vector>

#include "study/simulation/WallIndex.h"

namespace hybrid_slam::simulation {

/// Walls in one plane (m), read from a text file whose format doc/simulation.md describes.
class FloorPlan {
 public:
  explicit FloorPlan(std::vector<Wall> walls) : index_(std::move(walls)) {}
  /// @throws InputError naming file and line: unreadable file, unknown word, wrong count of numbers,
  /// zero-length wall, polygon that is not closed, door on no wall, no wall at all
  static FloorPlan load(const std::string& file);

  const std::vector<Wall>& walls() const { return index_.walls(); }
  /// Distance (m) to the first wall from `origin` towards `heading` (rad); nothing beyond maxRange.
  std::optional<double> castRay(const mrpt::math::TPoint2D& origin, double heading, double maxRange) const;
  /// m; infinity for a plan without walls
  double distanceToNearestWall(const mrpt::math::TPoint2D& p) const { return index_.nearestDistance(p); }
  /// Corners of the walls' bounding box (m); a whole circle stands for each arc.
  const mrpt::math::TPoint2D& lowerLeft() const { return index_.low(); }
  const mrpt::math::TPoint2D& upperRight() const { return index_.high(); }

 private:
  WallIndex index_;
};

}  // namespace hybrid_slam::simulation
