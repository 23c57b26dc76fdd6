#include "slam/plan/FloorPlan.h"

#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "slam/plan/BuildingFrame.h"
#include "slam/plan/GridProbe.h"
#include "slam/plan/WallClutter.h"
#include "slam/plan/WallCorners.h"
#include "slam/plan/WallLines.h"
#include "slam/plan/WallPairs.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPoint2D;

constexpr double kNarrowestDoor = 0.5, kWidestDoor = 2.5;  // m
constexpr double kPassage = 0.5;                           // m, free on both sides of a door
constexpr double kLeastWall = 0.3;                         // m, beside a door
constexpr double kHidden = 0.6;                            // m: longest gap that is no opening, if not free
constexpr double kShortest = 0.1;                          // m
constexpr double kMoved = 0.35;                            // m: closeCorners moves the ends of walls by less
// The error that all walls seen from the same poses share, measured on the simulated building.
constexpr double kPoseOffset = 0.01, kPoseAngle = mrpt::DEG2RAD(0.025);  // m, rad

/// A stretch of a line with a wall.
struct Stretch {
  double from, to;  ///< m along it
  int count;
  double forwards, backwards;  ///< m of faces in either direction
};

std::vector<Stretch> stretchesOf(const WallLine& group) {
  std::vector<Stretch> stretches;
  for (const Face& face : group.faces) {
    const double a = group.line.along(face.start), b = group.line.along(face.end);
    stretches.push_back(
        {std::min(a, b), std::max(a, b), face.count, std::max(0.0, b - a), std::max(0.0, a - b)});
  }
  std::sort(stretches.begin(), stretches.end(), [](const auto& a, const auto& b) { return a.from < b.from; });
  return stretches;
}

void extend(Stretch& stretch, const Stretch& by) {
  stretch.to = std::max(stretch.to, by.to);
  stretch.count = std::max(stretch.count, by.count);
  stretch.forwards += by.forwards;
  stretch.backwards += by.backwards;
}

/// Returns whether the gap is a passage through a wall, not the opening of an alcove or the space between two
/// objects.
bool isDoor(const Stretch& a, const Stretch& b, const LineEstimate& line, const GridProbe& probe) {
  const double width = b.from - a.to;
  if (width < kNarrowestDoor || width > kWidestDoor) return false;
  if (std::max(a.to - a.from, b.to - b.from) < width || std::min(a.to - a.from, b.to - b.from) < kLeastWall)
    return false;
  const TPoint2D middle = line.point((a.to + b.from) / 2);
  const TPoint2D across(-kPassage * std::sin(line.angle), kPassage * std::cos(line.angle));
  return probe.freeShare(line.point(a.to), line.point(b.from)) > 0.5 &&
         probe.freeShare(middle - across, middle + across) > 0.9;
}

/// Returns the walls of a line: joins overlapping stretches, and closes gaps unless they are free.
std::vector<Stretch> joined(const WallLine& group, const GridProbe& probe) {
  std::vector<Stretch> result;
  for (const Stretch& next : stretchesOf(group)) {
    if (!result.empty()) {
      Stretch& last = result.back();
      const double gap = next.from - last.to;
      if (gap < 2 * probe.cell() ||
          (gap < kHidden && probe.freeShare(group.line.point(last.to), group.line.point(next.from)) < 0.5)) {
        extend(last, next);
        continue;
      }
    }
    result.push_back(next);
  }
  return result;
}

PlanWall wallOf(const Stretch& stretch, const LineEstimate& line) {
  PlanWall wall;
  const bool isReversed = stretch.backwards > stretch.forwards;
  wall.line = isReversed ? line.reversed() : line;
  wall.start = line.point(isReversed ? stretch.to : stretch.from);
  wall.end = line.point(isReversed ? stretch.from : stretch.to);
  wall.line.covariance(0, 0) += kPoseOffset * kPoseOffset;
  wall.line.covariance(1, 1) += kPoseAngle * kPoseAngle;
  wall.count = stretch.count;
  return wall;
}

/// An opening, and the number of its line.
struct Door {
  Opening opening;
  int group;
};

/// Returns whether there is a wall of its line at either end.
bool isBetweenWalls(const Door& door, const std::vector<PlanWall>& walls) {
  const auto isWall = [&](const TPoint2D& end) {
    return std::any_of(walls.begin(), walls.end(), [&](const PlanWall& wall) {
      return wall.group == door.group &&
             std::min((wall.start - end).norm(), (wall.end - end).norm()) < kMoved;
    });
  };
  return isWall(door.opening.start) && isWall(door.opening.end);
}

}  // namespace

FloorPlan floorPlanOf(const std::vector<DatabaseLine>& lines, const OccupancyGrid& grid) {
  std::vector<Face> faces = facesOf(grid);
  for (const DatabaseLine& line : lines)
    for (const Face& face : facesOf(line, grid)) faces.push_back(face);
  std::vector<WallLine> groups = wallLinesOf(std::move(faces), grid.resolution());

  FloorPlan plan;
  const GridProbe probe(grid);
  const std::vector<BuildingDirection> directions = buildingDirections(groups);
  for (const BuildingDirection& direction : directions) plan.directions.push_back(direction.angle);
  std::vector<Door> doors;
  for (size_t i = 0; i < groups.size(); ++i) {
    const bool isSnapped = snapTo(directions, groups[i].line);
    const LineEstimate& line = groups[i].line;
    const std::vector<Stretch> stretches = joined(groups[i], probe);
    for (size_t j = 0; j < stretches.size(); ++j) {
      if (j > 0 && isDoor(stretches[j - 1], stretches[j], line, probe))
        doors.push_back(
            {{line.point(stretches[j - 1].to), line.point(stretches[j].from)}, static_cast<int>(i)});
      if (stretches[j].to - stretches[j].from < kShortest) continue;
      PlanWall& wall = plan.walls.emplace_back(wallOf(stretches[j], line));
      wall.group = static_cast<int>(i);
      wall.isSnapped = isSnapped;
    }
  }
  closeCorners(plan.walls, probe);
  removeClutter(plan.walls);
  for (const Door& door : doors)
    if (isBetweenWalls(door, plan.walls)) plan.openings.push_back(door.opening);
  pairFaces(plan.walls, probe);
  return plan;
}

}  // namespace hybrid_slam
