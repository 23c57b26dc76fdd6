#include "slam/grid/GlobalSearch.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "base/PoseDistance.h"

namespace hybrid_slam {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace {

constexpr double kWall = 0.6, kFree = 0.4;  // occupancy
constexpr double kGlobalStep = 0.2;         // m
constexpr double kReach = 500;              // m
constexpr double kGlobalStepAngle = mrpt::DEG2RAD(2.0), kWindow = mrpt::DEG2RAD(6.0);
constexpr size_t kGlobalBeams = 60;
constexpr double kApart = 0.5, kApartAngle = mrpt::DEG2RAD(10.0);  // of two poses

/// Limits the search to cells within kReach: a map may be kilometres long.
CellBox within(const OccupancyGrid& grid, const TPoint2D& around) {
  CellBox box = grid.tiles().bounds();
  const CellIndex low = grid.cellOf(around.x - kReach, around.y - kReach),
                  high = grid.cellOf(around.x + kReach, around.y + kReach);
  box.min = {std::max(box.min.x, low.x), std::max(box.min.y, low.y)};
  box.max = {std::min(box.max.x, high.x), std::min(box.max.y, high.y)};
  return box;
}

constexpr char kUnknown = 2;

/// Returns the sum of the values, each at most 2, if that is at least `least`; else 0.
template <class Value>
int sumAbove(int least, const std::vector<CellIndex>& ends, const Value& value) {
  int sum = 0, left = 2 * static_cast<int>(ends.size());
  for (const CellIndex& end : ends) {
    sum += value(end);
    left -= 2;
    if (sum + left < least) return 0;
  }
  return sum;
}

std::vector<double> lattice(const std::vector<double>& headings) {
  std::vector<double> all;
  if (headings.empty())
    for (int k = 0; k < static_cast<int>(std::lround(2 * M_PI / kGlobalStepAngle)); ++k)
      all.push_back(k * kGlobalStepAngle);
  for (const double heading : headings)
    for (double offset = -kWindow; offset < kWindow + kGlobalStepAngle / 2; offset += kGlobalStepAngle)
      all.push_back(heading + offset);
  return all;
}

}  // namespace

BeamShares beamShares(const ScanBeams& scan, const TPose2D& robot, const OccupancyGrid& grid) {
  const GridPose frame(robot, scan, grid.resolution());
  const int near = static_cast<int>(std::lround(0.15 / grid.resolution()));
  const double stop = 0.3 / grid.resolution();  // cells at both ends that prove nothing
  const double solid = OccupancyGrid::valueOf(0.8), wall = OccupancyGrid::valueOf(kWall),
               free = OccupancyGrid::valueOf(0.3);
  TileReader reader(grid.tiles());
  size_t explained = 0, contradicted = 0;
  for (const ScanBeams::Ray& ray : scan.rays) {
    const double range = ray.range / grid.resolution(), dx = frame.dirX(ray), dy = frame.dirY(ray);
    const auto cellAt = [&](double distance) {
      return CellIndex{static_cast<int>(std::floor(frame.origin(ray).x + distance * dx)),
                       static_cast<int>(std::floor(frame.origin(ray).y + distance * dy))};
    };
    const auto valueAt = [&](const CellIndex& cell) { return reader.at(cell.x, cell.y); };
    bool isThrough = false;
    for (double distance = stop; distance < range - stop && !isThrough; distance += 1)
      isThrough = valueAt(cellAt(distance)) > solid;
    const CellIndex end = cellAt(range);
    bool endsAtWall = false;
    for (int j = -near; j <= near && !endsAtWall; ++j)
      for (int i = -near; i <= near && !endsAtWall; ++i) endsAtWall = valueAt({end.x + i, end.y + j}) >= wall;
    explained += endsAtWall && !isThrough;
    contradicted += isThrough || (!endsAtWall && valueAt(end) < free);
  }
  const double beams = std::max(1.0, static_cast<double>(scan.rays.size()));
  return {static_cast<double>(explained) / beams, static_cast<double>(contradicted) / beams};
}

GlobalSearch::GlobalSearch(const OccupancyGrid& grid, const TPoint2D& around) {
  const int scale = std::max(1, static_cast<int>(kGlobalStep / grid.resolution()));
  const auto coarse = [scale](int cell) {
    return static_cast<int>(std::floor(static_cast<double>(cell) / scale));
  };
  size_ = scale * grid.resolution();
  const CellBox box = within(grid, around);
  if (box.empty()) return;
  min_ = {coarse(box.min.x) - 2, coarse(box.min.y) - 2};
  width_ = coarse(box.max.x) - min_.x + 3, height_ = coarse(box.max.y) - min_.y + 3;
  wall_.assign(static_cast<size_t>(width_) * static_cast<size_t>(height_), 0);
  std::vector<char> isFree = wall_;
  TileReader reader(grid.tiles());
  const double wallValue = OccupancyGrid::valueOf(kWall), freeValue = OccupancyGrid::valueOf(kFree);
  for (int y = box.min.y; y <= box.max.y; ++y)
    for (int x = box.min.x; x <= box.max.x; ++x) {
      const double value = reader.at(x, y);
      const int cx = coarse(x) - min_.x, cy = coarse(y) - min_.y;
      if (value < freeValue) isFree[index(cx, cy)] = 1;
      if (value <= wallValue) continue;
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
          char& score = wall_[index(cx + i, cy + j)];
          score = std::max(score, static_cast<char>(i == 0 && j == 0 ? 2 : 1));
        }
    }
  for (int y = -kBlock; y < height_; ++y)
    for (int x = -kBlock; x < width_; ++x) {
      int most = 0;
      for (int j = 0; j < kBlock; ++j)
        for (int i = 0; i < kBlock; ++i) most = std::max(most, wall(x + i, y + j));
      highest_.push_back(static_cast<char>(most));
    }
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      if (isFree[index(x, y)]) free_.push_back({x, y});
}

std::vector<GlobalSearch::Place> GlobalSearch::operator()(const ScanBeams& scan,
                                                          const std::vector<double>& headings, size_t count,
                                                          double leastScore) const {
  if (scan.rays.empty()) return {};
  const size_t every = (scan.rays.size() + kGlobalBeams - 1) / kGlobalBeams;
  std::vector<Place> places;
  for (const double heading : lattice(headings)) {
    // Beam ends in coarse cells from the robot, which stands in the middle of one.
    const GridPose frame({0, 0, heading}, scan, size_);
    std::vector<CellIndex> ends;
    for (size_t i = 0; i < scan.rays.size(); i += every) {
      const ScanBeams::Ray& ray = scan.rays[i];
      const double range = ray.range / size_;
      ends.push_back({static_cast<int>(std::floor(0.5 + frame.origin(ray).x + range * frame.dirX(ray))),
                      static_cast<int>(std::floor(0.5 + frame.origin(ray).y + range * frame.dirY(ray)))});
    }
    const int least =
        std::max(1, static_cast<int>(std::ceil(2 * leastScore * static_cast<double>(ends.size()))));
    // No cell of a block can reach the least score if the highest values near it do not.
    std::vector<char> isHopeless(static_cast<size_t>((width_ / kBlock + 1) * (height_ / kBlock + 1)),
                                 kUnknown);
    for (const CellIndex& cell : free_) {
      const int bx = cell.x / kBlock, by = cell.y / kBlock;
      char& block = isHopeless[static_cast<size_t>(by * (width_ / kBlock + 1) + bx)];
      if (block == kUnknown)
        block = !sumAbove(least, ends, [&](const CellIndex& end) {
          return highest(bx * kBlock + end.x, by * kBlock + end.y);
        });
      if (block) continue;
      const int score =
          sumAbove(least, ends, [&](const CellIndex& end) { return wall(cell.x + end.x, cell.y + end.y); });
      if (score == 0) continue;
      const TPoint2D at = centre(cell);
      places.push_back(
          {{at.x, at.y, mrpt::math::wrapToPi(heading)}, 0.5 * score / static_cast<double>(ends.size())});
    }
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.score > b.score; });
  std::vector<Place> best;
  for (const Place& place : places) {
    if (best.size() == count) break;
    const bool isNear = std::any_of(best.begin(), best.end(), [&p = place.pose](const Place& other) {
      return isWithin(p, other.pose, kApart, kApartAngle);
    });
    if (!isNear) best.push_back(place);
  }
  return best;
}

std::vector<TPoint2D> GlobalSearch::freePlaces(double spacing) const {
  std::vector<TPoint2D> places;
  std::set<std::pair<int, int>> squares;
  const int side = std::max(1, static_cast<int>(spacing / size_));
  for (const CellIndex& cell : free_)
    if (squares.insert({cell.x / side, cell.y / side}).second) places.push_back(centre(cell));
  return places;
}

}  // namespace hybrid_slam
