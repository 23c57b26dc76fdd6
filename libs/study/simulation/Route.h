/// @file Route.h
/// @brief Where the robot drives: way points and turns, from a text file, as a pose for every moment.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <string>
#include <vector>

namespace hybrid_slam::simulation {

class FloorPlan;

/// A path of pieces of constant speed and turn rate: straight runs, circular arcs, turns on the spot.
///
/// Poses are the robot's centre in the frame of the floor plan (m, rad), times are seconds from the start.
class Route {
 public:
  /// One stretch of constant forward speed v (m/s) and turn rate omega (rad/s).
  struct Piece {
    double startTime = 0, duration = 0;  ///< s
    mrpt::math::TPose2D start;
    double v = 0, omega = 0;
    std::string where;  ///< "file F, line N"

    mrpt::math::TPose2D poseAfter(double seconds) const;
  };

  /// Forward distance (m) and rotation (rad, counted on through full turns) since the start.
  struct Progress {
    double distance = 0, rotation = 0;
  };

  explicit Route(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {}
  /// The words of the file are in doc/simulation.md.
  /// @throws InputError naming file and line
  static Route load(const std::string& file);

  const std::vector<Piece>& pieces() const { return pieces_; }
  double duration() const;  ///< s
  /// Times before the start and after the end are those of the start and the end.
  mrpt::math::TPose2D poseAt(double time) const;
  Progress progressAt(double time) const;

  /// @throws InputError where a way point lies, or the path passes, nearer than `robotRadius` (m) to a wall
  void checkClear(const FloorPlan& plan, double robotRadius) const;

 private:
  std::vector<Piece> pieces_;  ///< at least one, in order of time, without gaps
};

}  // namespace hybrid_slam::simulation
