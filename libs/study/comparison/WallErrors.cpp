#include "study/comparison/WallErrors.h"

#include <mrpt/maps/COccupancyGridMap2D.h>

#include <stdexcept>

#include "study/comparison/Statistics.h"

namespace hybrid_slam::comparison {
namespace {

using mrpt::maps::COccupancyGridMap2D;
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr float kOccupied = 0.65f;

bool isOccupied(const COccupancyGridMap2D& map, int x, int y) { return 1 - map.getCell(x, y) > kOccupied; }

}  // namespace

std::vector<TPoint2D> occupiedCells(const COccupancyGridMap2D& map) {
  std::vector<TPoint2D> cells;
  for (int y = 0; y < static_cast<int>(map.getSizeY()); ++y)
    for (int x = 0; x < static_cast<int>(map.getSizeX()); ++x)
      if (isOccupied(map, x, y)) cells.emplace_back(map.idx2x(x), map.idx2y(y));
  return cells;
}

WallErrors wallErrors(const COccupancyGridMap2D& map, const simulation::BuildingPlan& plan,
                      const TPose2D& alignment) {
  std::vector<double> distances;
  double sum = 0;
  for (const TPoint2D& cell : occupiedCells(map)) {
    distances.push_back(plan.distanceToNearestWall(alignment.composePoint(cell)));
    sum += distances.back();
  }
  if (distances.empty()) throw std::runtime_error("the map has no occupied cells");
  return {sum / static_cast<double>(distances.size()), interpolatedQuantile(distances, 0.95)};
}

}  // namespace hybrid_slam::comparison
