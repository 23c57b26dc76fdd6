#include "study/simulation/Route.h"

#include <algorithm>
#include <cmath>

#include "base/Errors.h"
#include "base/Numbers.h"
#include "study/simulation/BuildingPlan.h"

namespace hybrid_slam::simulation {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace {

constexpr double kCheckStep = 0.02;  // m between clearance checks along the path

std::string positionText(const TPose2D& pose) {
  return "at (" + fixedText(pose.x, 2) + ", " + fixedText(pose.y, 2) + ")";
}

}  // namespace

TPose2D Route::Piece::poseAfter(double seconds) const {
  const double distance = v * seconds, turn = omega * seconds;
  // The chord of the arc, along the mean of the two headings.
  const double chord = std::abs(turn) < 1e-9 ? distance : distance * std::sin(turn / 2) / (turn / 2);
  return {start.x + chord * std::cos(start.phi + turn / 2), start.y + chord * std::sin(start.phi + turn / 2),
          start.phi + turn};
}

double Route::duration() const { return pieces_.back().startTime + pieces_.back().duration; }

TPose2D Route::poseAt(double time) const {
  auto after = std::upper_bound(pieces_.begin() + 1, pieces_.end(), time,
                                [](double t, const Piece& piece) { return t < piece.startTime; });
  const Piece& piece = *(after - 1);
  return piece.poseAfter(std::clamp(time - piece.startTime, 0.0, piece.duration));
}

Route::Progress Route::progressAt(double time) const {
  Progress progress;
  for (const Piece& piece : pieces_) {
    const double seconds = std::clamp(time - piece.startTime, 0.0, piece.duration);
    progress.distance += piece.v * seconds;
    progress.rotation += piece.omega * seconds;
  }
  return progress;
}

void Route::checkClear(const BuildingPlan& plan, double robotRadius) const {
  const std::string radius = numberText(robotRadius) + " m";
  const auto check = [&](const TPose2D& pose, const Piece& piece, const char* what) {
    if (plan.distanceToNearestWall({pose.x, pose.y}) < robotRadius)
      throw InputError(
          std::string(what) + " " + positionText(pose), piece.where,
          "expected all walls, doors and boxes at least the robot's radius, " + radius + ", away");
  };
  for (const Piece& piece : pieces_) check(piece.start, piece, "way point inside a wall");
  for (const Piece& piece : pieces_) {
    const double length = std::abs(piece.v) * piece.duration;
    const int steps = static_cast<int>(std::ceil(length / kCheckStep));
    TPose2D last = piece.start;
    check(piece.poseAfter(piece.duration), piece, "way point inside a wall");
    for (int i = 1; i <= steps; ++i) {
      const TPose2D next = piece.poseAfter(piece.duration * i / steps);
      check(next, piece, "path hits a wall");
      // A robot of radius 0 is never too close to a wall, but must not cross one.
      const double dx = next.x - last.x, dy = next.y - last.y;
      if (plan.castRay({last.x, last.y}, std::atan2(dy, dx), std::hypot(dx, dy)))
        throw InputError("path crosses a wall " + positionText(next), piece.where,
                         "expected a path through free space");
      last = next;
    }
  }
}

}  // namespace hybrid_slam::simulation
