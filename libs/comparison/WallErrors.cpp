#include "comparison/WallErrors.h"

#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "comparison/Statistics.h"

namespace hybrid_slam {
namespace {

using mrpt::maps::COccupancyGridMap2D;
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr float kOccupied = 0.65f;
constexpr double kSampleStep = 0.1;     // m, along a wall
constexpr double kReach = 1;            // m, to both sides of it
constexpr double kClearReach = 1.5;     // m: what the reach may take in of a map that is bent
constexpr double kClearance = 0.5;      // m
constexpr double kLargestSpread = 0.2;  // m: wider than a wall that was drawn once, noise and all
constexpr size_t kLeastInARow = 3;

bool isOccupied(const COccupancyGridMap2D& map, int x, int y) { return 1 - map.getCell(x, y) > kOccupied; }

/// Whether the normal of a wall meets nothing but this wall.
bool isFreeStanding(const FloorPlan& plan, const TPoint2D& sample, const TPoint2D& normal) {
  constexpr double kStep = 0.1;
  for (double offset = -kClearReach; offset <= kClearReach; offset += kStep) {
    const double own = std::min(std::abs(offset), kClearance) - 1e-6;
    if (plan.distanceToNearestWall(sample + normal * offset) < own) return false;
  }
  return true;
}

struct Profile {
  bool isShown = false;
  double spread = 0;  ///< m, from the first occupied cell to the last
};

/// The occupied cells along a wall's normal; all in the map's frame.
Profile profileAt(const COccupancyGridMap2D& map, const TPoint2D& sample, const TPoint2D& normal) {
  const double step = map.getResolution() / 2;
  double first = 0, last = 0;
  Profile profile;
  for (double offset = -kReach; offset <= kReach; offset += step) {
    const TPoint2D p = sample + normal * offset;
    const int x = map.x2idx(p.x), y = map.y2idx(p.y);
    if (x < 0 || y < 0 || x >= static_cast<int>(map.getSizeX()) || y >= static_cast<int>(map.getSizeY()) ||
        !isOccupied(map, x, y))
      continue;
    if (!profile.isShown) first = offset;
    last = offset;
    profile.isShown = true;
  }
  profile.spread = last - first;
  return profile;
}

double doubledShare(const COccupancyGridMap2D& map, const FloorPlan& plan, const TPose2D& alignment) {
  const TPose2D toMap = TPose2D() - alignment;
  size_t shown = 0, doubled = 0;
  for (const Wall& wall : plan.walls()) {
    if (wall.isArc()) continue;
    const double length = wall.length();
    const TPoint2D along = (wall.end - wall.start) * (1 / length), normal(-along.y, along.x);
    const TPoint2D mapNormal = toMap.composePoint(normal) - toMap.composePoint({0, 0});
    size_t inARow = 0;
    const auto endRow = [&] {
      if (inARow >= kLeastInARow) doubled += inARow;
      inARow = 0;
    };
    for (double way = kSampleStep / 2; way < length; way += kSampleStep) {
      const TPoint2D sample = wall.start + along * way;
      const Profile profile = isFreeStanding(plan, sample, normal)
                                  ? profileAt(map, toMap.composePoint(sample), mapNormal)
                                  : Profile();
      shown += profile.isShown;
      if (profile.spread > kLargestSpread)
        ++inARow;
      else
        endRow();
    }
    endRow();
  }
  return shown == 0 ? 0 : static_cast<double>(doubled) / static_cast<double>(shown);
}

}  // namespace

std::vector<TPoint2D> occupiedCells(const COccupancyGridMap2D& map) {
  std::vector<TPoint2D> cells;
  for (int y = 0; y < static_cast<int>(map.getSizeY()); ++y)
    for (int x = 0; x < static_cast<int>(map.getSizeX()); ++x)
      if (isOccupied(map, x, y)) cells.emplace_back(map.idx2x(x), map.idx2y(y));
  return cells;
}

WallErrors wallErrors(const COccupancyGridMap2D& map, const FloorPlan& plan, const TPose2D& alignment) {
  std::vector<double> distances;
  double sum = 0;
  for (const TPoint2D& cell : occupiedCells(map)) {
    distances.push_back(plan.distanceToNearestWall(alignment.composePoint(cell)));
    sum += distances.back();
  }
  if (distances.empty()) throw std::runtime_error("the map has no occupied cells");
  return {sum / static_cast<double>(distances.size()), quantile(distances, 0.95),
          doubledShare(map, plan, alignment)};
}

COccupancyGridMap2D loadGridMap(const std::string& file) {
  COccupancyGridMap2D map;
  try {
    mrpt::io::CFileGZInputStream in;
    if (!in.open(file)) throw std::runtime_error("cannot be opened");
    mrpt::serialization::archiveFrom(in) >> map;
  } catch (const std::exception&) {  // MRPT's texts run over many lines
    throw std::runtime_error("no grid map can be read: " + file);
  }
  return map;
}

}  // namespace hybrid_slam
