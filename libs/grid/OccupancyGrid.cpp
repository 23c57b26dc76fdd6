#include "grid/OccupancyGrid.h"

#include <algorithm>
#include <cmath>

#include "grid/RayTraversal.h"

namespace hybrid_slam {
namespace {

int logOdds(double p) {
  return static_cast<int>(std::lround(std::log(p / (1 - p)) / OccupancyGrid::kLogOddsScale));
}

/// The cells that one scan hits: a bitmap over their bounding box, kept between calls to save the allocation.
class HitCells {
 public:
  explicit HitCells(const std::vector<CellIndex>& cells) : bits_(buffer()) {
    if (cells.empty()) return;
    box_ = {cells.front(), cells.front()};
    for (const CellIndex& c : cells) {
      box_.min = {std::min(box_.min.x, c.x), std::min(box_.min.y, c.y)};
      box_.max = {std::max(box_.max.x, c.x), std::max(box_.max.y, c.y)};
    }
    width_ = box_.max.x - box_.min.x + 1;
    bits_.assign(static_cast<size_t>(width_) * static_cast<size_t>(box_.max.y - box_.min.y + 1), false);
  }
  bool contains(int x, int y) const {
    return x >= box_.min.x && x <= box_.max.x && y >= box_.min.y && y <= box_.max.y && bits_[index(x, y)];
  }
  /// Whether the cell was not there yet.
  bool add(CellIndex c) {
    const bool isNew = !bits_[index(c.x, c.y)];
    bits_[index(c.x, c.y)] = true;
    return isNew;
  }

 private:
  size_t index(int x, int y) const {
    return static_cast<size_t>(y - box_.min.y) * static_cast<size_t>(width_) +
           static_cast<size_t>(x - box_.min.x);
  }
  static std::vector<bool>& buffer() {
    thread_local std::vector<bool> bits;
    return bits;
  }
  std::vector<bool>& bits_;
  CellBox box_;
  int width_ = 0;
};

}  // namespace

void GridOptions::describe(OptionTable& t) {
  t.add("resolution", resolution, 0.01, 1, "m", "size of a cell; the paper's is 5 cm");
  t.add("max_range", maxRange, 0.5, 200, "m",
        "readings at or beyond it are no readings: 20 m for an LMS-100");
  t.add("p_hit", pHit, 0.51, 0.99, "", "occupancy that one hit alone means");
  t.add("p_miss", pMiss, 0.01, 0.49, "",
        "occupancy that one crossing beam alone means; near 0.5, so that what was mapped first prevails");
  t.add("p_min", pMin, 0.001, 0.49, "", "least occupancy of a cell, so that a map can change its mind");
  t.add("p_max", pMax, 0.51, 0.999, "", "greatest occupancy of a cell");
}

double OccupancyGrid::occupancy(CellIndex cell) const {
  return 1 / (1 + std::exp(-kLogOddsScale * tiles_.at(cell)));
}

CellIndex OccupancyGrid::cellOf(double x, double y) const {
  return {static_cast<int>(std::floor(x / resolution_)), static_cast<int>(std::floor(y / resolution_))};
}

void OccupancyGrid::insert(const ScanBeams& scan, const mrpt::math::TPose2D& robot,
                           const GridOptions& options) {
  // A probability nearer to 0.5 than the smallest step still counts as one.
  const int hit = std::max(logOdds(options.pHit), 1), miss = std::min(logOdds(options.pMiss), -1);
  const int lowest = logOdds(options.pMin), highest = logOdds(options.pMax);
  const GridPose pose(robot, scan, resolution_);

  std::vector<CellIndex> ends;
  ends.reserve(scan.rays.size());
  for (const auto& ray : scan.rays) {
    const double range = ray.range / resolution_;
    ends.push_back({static_cast<int>(std::floor(pose.originX + range * pose.dirX(ray))),
                    static_cast<int>(std::floor(pose.originY + range * pose.dirY(ray)))});
  }
  HitCells hits(ends);
  TileWriter cells(tiles_);
  for (const CellIndex& end : ends)
    if (hits.add(end)) {
      int8_t& cell = cells.at(end.x, end.y);
      cell = static_cast<int8_t>(std::min<int>(cell + hit, highest));
    }
  for (const auto& ray : scan.rays)
    traverseRay(pose.originX, pose.originY, pose.dirX(ray), pose.dirY(ray), ray.range / resolution_,
                [&](int x, int y, double, double) {
                  if (hits.contains(x, y)) return true;
                  int8_t& cell = cells.at(x, y);
                  if (cell > lowest) cell = static_cast<int8_t>(std::max<int>(cell + miss, lowest));
                  return true;
                });
}

}  // namespace hybrid_slam
