#include "study/simulation/MovableThings.h"

#include <algorithm>
#include <cmath>

#include "base/Errors.h"
#include "base/Numbers.h"
#include "study/simulation/BuildingPlan.h"
#include "study/simulation/NoiseStream.h"
#include "study/simulation/RecordFile.h"

namespace hybrid_slam::simulation {

using mrpt::math::TPoint2D;

namespace {

constexpr size_t kMostPlaces = 1000;

std::vector<Wall> rectangle(const TPoint2D& low, const TPoint2D& size) {
  const double right = low.x + size.x, top = low.y + size.y;
  const std::vector<TPoint2D> corners = {low, {right, low.y}, {right, top}, {low.x, top}};
  std::vector<Wall> sides;
  for (size_t i = 0; i < 4; ++i) sides.push_back(Wall::straight(corners[i], corners[(i + 1) % 4]));
  return sides;
}

/// Returns whether a wall crosses the rectangle's sides or lies inside.
bool touchesWall(const BuildingPlan& plan, const TPoint2D& low, const TPoint2D& high) {
  for (const Wall& side : rectangle(low, {high.x - low.x, high.y - low.y})) {
    const double dx = side.end.x - side.start.x, dy = side.end.y - side.start.y;
    if (plan.castRay(side.start, std::atan2(dy, dx), std::hypot(dx, dy))) return true;
  }
  return std::any_of(plan.walls().begin(), plan.walls().end(), [&](const Wall& wall) {
    const TPoint2D& p = wall.start;
    return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y;
  });
}

Wall doorOf(const Record& record, const BuildingPlan& plan) {
  expectNumbers(record, "X1 Y1 X2 Y2");
  const std::vector<double>& v = record.numbers;
  const Wall door = Wall::straight({v[0], v[1]}, {v[2], v[3]});
  if (door.length() < kTolerance)
    throw InputError("door of zero length", record.where, "expected its ends at least 1 mm apart");
  if (plan.distanceToNearestWall(door.pointAt(0.5)) < kTolerance)
    throw InputError("door along a wall", record.where, "expected a gap of the floor plan there");
  return door;
}

}  // namespace

MovableThings MovableThings::load(const std::string& file, const BuildingPlan& plan) {
  MovableThings things;
  size_t places = 0;
  for (const Record& record : readRecords(file, {"door", "box"})) {
    const std::vector<double>& v = record.numbers;
    if (record.word == "door") {
      things.doors_.push_back(doorOf(record, plan));
      continue;
    }
    if (v.size() % 2 != 0 || v.size() < 6)
      throw InputError("`box` with " + std::to_string(v.size()) + " numbers", record.where,
                       "expected `box WIDTH HEIGHT X1 Y1 X2 Y2 ...` with at least two places");
    if (v[0] < kTolerance || v[1] < kTolerance)
      throw InputError("box without area", record.where, "expected WIDTH and HEIGHT of at least 1 mm");
    Box box{{v[0], v[1]}, {}, record.where};
    for (size_t i = 2; i < v.size(); i += 2) box.places.emplace_back(v[i], v[i + 1]);
    places += box.places.size();
    if (places > kMostPlaces)
      throw InputError("too many places", record.where, "expected at most " + std::to_string(kMostPlaces));
    things.boxes_.push_back(std::move(box));
  }
  things.expectFree(plan);
  return things;
}

void MovableThings::expectFree(const BuildingPlan& plan) const {
  const BuildingPlan obstacles = plan.with(doors_);
  for (const Box& box : boxes_)
    for (const TPoint2D& place : box.places) {
      const TPoint2D low(place.x - kTolerance, place.y - kTolerance);
      const TPoint2D high(place.x + box.size.x + kTolerance, place.y + box.size.y + kTolerance);
      const auto fail = [&](const char* what) {
        throw InputError(
            "box at (" + fixedText(place.x, 2) + ", " + fixedText(place.y, 2) + ") stands on " + what,
            box.where, "expected its places at least 1 mm from all walls, doors and places of other boxes");
      };
      if (touchesWall(obstacles, low, high)) fail("a wall or a door");
      for (const Box& other : boxes_)
        for (const TPoint2D& p : other.places)
          if (&other != &box && p.x <= high.x && p.y <= high.y && p.x + other.size.x >= low.x &&
              p.y + other.size.y >= low.y)
            fail("a place of another box");
    }
}

std::vector<PlacedThing> MovableThings::inSession(uint64_t seed, uint64_t session) const {
  std::vector<PlacedThing> placed;
  for (size_t i = 0; i < doors_.size(); ++i)
    if (noiseStream(seed, session, NoiseSource::doors, i).uniform() < 0.5)
      placed.push_back({"door " + std::to_string(i + 1), {doors_[i]}});
  for (size_t i = 0; i < boxes_.size(); ++i) {
    const Box& box = boxes_[i];
    RandomStream random = noiseStream(seed, session, NoiseSource::boxes, i);
    const TPoint2D& place =
        box.places[static_cast<size_t>(random.uniform() * static_cast<double>(box.places.size()))];
    placed.push_back({"box " + std::to_string(i + 1), rectangle(place, box.size)});
  }
  return placed;
}

std::vector<Wall> MovableThings::everywhere() const {
  std::vector<Wall> walls = doors_;
  for (const Box& box : boxes_)
    for (const TPoint2D& place : box.places)
      for (const Wall& wall : rectangle(place, box.size)) walls.push_back(wall);
  return walls;
}

std::vector<Wall> wallsOf(const std::vector<PlacedThing>& things) {
  std::vector<Wall> walls;
  for (const PlacedThing& thing : things) walls.insert(walls.end(), thing.walls.begin(), thing.walls.end());
  return walls;
}

}  // namespace hybrid_slam::simulation
