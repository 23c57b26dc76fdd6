/// @file Route.h
/// @brief A route of way points and turns from a text file, as a pose over time.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <string>
#include <vector>

namespace hybrid_slam::simulation {

class BuildingPlan;

/// A path of pieces with constant speed and turn rate: straight lines, circular arcs, turns on the spot.
///
/// Poses are the robot's centre in the frame of the floor plan (m, rad), times are seconds from the start.
class Route {
 public:
  /// A piece with constant forward speed v (m/s) and turn rate omega (rad/s).
  struct Piece {
    double startTime = 0, duration = 0;  ///< s
    mrpt::math::TPose2D start;
    double v = 0, omega = 0;
    std::string where;  ///< "file F, line N"

    mrpt::math::TPose2D poseAfter(double seconds) const;
  };

  /// Forward distance (m) and rotation (rad, not wrapped) since the start.
  struct Progress {
    double distance = 0, rotation = 0;
  };

  explicit Route(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {}
  /// File format: doc/simulation.md.
  /// @throws InputError naming file and line
  static Route load(const std::string& file);

  const std::vector<Piece>& pieces() const { return pieces_; }
  double duration() const;  ///< s
  /// Returns the pose at a time (s), clamped to the duration of the route.
  mrpt::math::TPose2D poseAt(double time) const;
  Progress progressAt(double time) const;

  /// @throws InputError if a way point or the path is closer than `robotRadius` (m) to a wall
  void checkClear(const BuildingPlan& plan, double robotRadius) const;

 private:
  std::vector<Piece> pieces_;  ///< at least one, in order of time, without gaps
};

}  // namespace hybrid_slam::simulation
