/// @file MovableThings.h
/// @brief Doors and boxes that differ between sessions in the same building.
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <cstdint>
#include <string>
#include <vector>

#include "study/simulation/Wall.h"

namespace hybrid_slam::simulation {

class BuildingPlan;

/// A door or a box that stands in the building in one session.
struct PlacedThing {
  std::string name;         ///< "door N" or "box N", numbered from 1 in file order
  std::vector<Wall> walls;  ///< in the frame of the floor plan (m)
};

/// Returns the walls of closed doors and of boxes.
std::vector<Wall> wallsOf(const std::vector<PlacedThing>& things);

/// Doors that are open or closed, and boxes that stand at one of several places, in each session.
class MovableThings {
 public:
  MovableThings() = default;
  /// File format: doc/simulation.md.
  /// @throws InputError naming file and line: as readRecords, door without length or along a wall, box
  ///         without area or with fewer than two places, place on a wall, a door or a place of another box
  static MovableThings load(const std::string& file, const BuildingPlan& plan);

  bool empty() const { return doors_.empty() && boxes_.empty(); }
  /// Returns the closed doors and all boxes of a session. The same seed and session give the same result;
  /// each thing has its own random stream.
  std::vector<PlacedThing> inSession(uint64_t seed, uint64_t session) const;
  /// Returns all doors, closed, and every box at all its places: the obstacles that a route must avoid in any
  /// session.
  std::vector<Wall> everywhere() const;

 private:
  struct Box {
    mrpt::math::TPoint2D size;                 ///< m
    std::vector<mrpt::math::TPoint2D> places;  ///< lower left corners
    std::string where;                         ///< "file F, line N"
  };
  void expectFree(const BuildingPlan& plan) const;

  std::vector<Wall> doors_;
  std::vector<Box> boxes_;
};

}  // namespace hybrid_slam::simulation
