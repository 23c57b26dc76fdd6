#include "slam/grid/GlobalSearch.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

namespace hybrid_slam {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace {

constexpr double kWall = 0.6, kFree = 0.4;  // occupancy
constexpr double kStep = 0.2;               // m
constexpr double kReach = 500;              // m
constexpr double kStepAngle = 2 * M_PI / 180, kWindow = 6 * M_PI / 180;
constexpr size_t kMostBeams = 60;
constexpr double kApart = 0.5, kApartAngle = 10 * M_PI / 180;  // of two poses

/// The value of a cell with this occupancy.
double logOdds(double occupancy) {
  return std::log(occupancy / (1 - occupancy)) / OccupancyGrid::kLogOddsScale;
}

/// The map in cells of kStep: where free, and where there is a wall in the cell (2) or a neighbour (1).
class CoarseMap {
 public:
  CoarseMap(const OccupancyGrid& grid, const TPoint2D& around)
      : scale_(std::max(1, static_cast<int>(kStep / grid.resolution()))) {
    size_ = scale_ * grid.resolution();
    const CellBox box = within(grid, around);
    if (box.empty()) return;
    min_ = {coarse(box.min.x) - 2, coarse(box.min.y) - 2};
    width_ = coarse(box.max.x) - min_.x + 3, height_ = coarse(box.max.y) - min_.y + 3;
    wall_.assign(static_cast<size_t>(width_) * static_cast<size_t>(height_), 0);
    free_ = wall_;
    TileReader reader(grid.tiles());
    const double wall = logOdds(kWall), free = logOdds(kFree);
    for (int y = box.min.y; y <= box.max.y; ++y)
      for (int x = box.min.x; x <= box.max.x; ++x) {
        const double value = reader.at(x, y);
        const int cx = coarse(x) - min_.x, cy = coarse(y) - min_.y;
        if (value < free) free_[index(cx, cy)] = 1;
        if (value <= wall) continue;
        for (int j = -1; j <= 1; ++j)
          for (int i = -1; i <= 1; ++i) {
            char& score = wall_[index(cx + i, cy + j)];
            score = std::max(score, static_cast<char>(i == 0 && j == 0 ? 2 : 1));
          }
      }
  }
  double size() const { return size_; }
  int width() const { return width_; }
  int height() const { return height_; }
  bool isFree(int x, int y) const { return free_[index(x, y)]; }
  /// Cells outside the map hold no wall.
  int wall(int x, int y) const {
    return x >= 0 && y >= 0 && x < width_ && y < height_ ? wall_[index(x, y)] : 0;
  }
  TPoint2D centre(int x, int y) const { return {(min_.x + x + 0.5) * size_, (min_.y + y + 0.5) * size_}; }

 private:
  /// The cells of the map within kReach: a map may be kilometres long.
  static CellBox within(const OccupancyGrid& grid, const TPoint2D& around) {
    CellBox box = grid.tiles().bounds();
    const CellIndex low = grid.cellOf(around.x - kReach, around.y - kReach),
                    high = grid.cellOf(around.x + kReach, around.y + kReach);
    box.min = {std::max(box.min.x, low.x), std::max(box.min.y, low.y)};
    box.max = {std::min(box.max.x, high.x), std::min(box.max.y, high.y)};
    return box;
  }
  int coarse(int cell) const { return static_cast<int>(std::floor(static_cast<double>(cell) / scale_)); }
  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x);
  }

  int scale_;
  double size_ = kStep;
  CellIndex min_{0, 0};
  int width_ = 0, height_ = 0;
  std::vector<char> wall_, free_;
};

std::vector<double> lattice(const std::vector<double>& headings) {
  std::vector<double> all;
  if (headings.empty())
    for (int k = 0; k < static_cast<int>(std::lround(2 * M_PI / kStepAngle)); ++k)
      all.push_back(k * kStepAngle);
  for (const double heading : headings)
    for (double offset = -kWindow; offset < kWindow + kStepAngle / 2; offset += kStepAngle)
      all.push_back(heading + offset);
  return all;
}

}  // namespace

double contradictedShare(const ScanBeams& scan, const TPose2D& robot, const OccupancyGrid& grid) {
  const GridPose frame(robot, scan, grid.resolution());
  const int near = static_cast<int>(std::lround(0.15 / grid.resolution()));
  const double stop = 0.3 / grid.resolution();  // cells at both ends that prove nothing
  const double solid = logOdds(0.8), wall = logOdds(kWall), free = logOdds(0.3);
  TileReader reader(grid.tiles());
  size_t contradicted = 0;
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
    bool endsInTheFree = !isThrough && valueAt(end) < free;
    for (int j = -near; j <= near && endsInTheFree; ++j)
      for (int i = -near; i <= near && endsInTheFree; ++i)
        endsInTheFree = valueAt({end.x + i, end.y + j}) < wall;
    contradicted += isThrough || endsInTheFree;
  }
  return scan.rays.empty() ? 0 : static_cast<double>(contradicted) / static_cast<double>(scan.rays.size());
}

std::vector<TPose2D> globalSearch(const ScanBeams& scan, const OccupancyGrid& grid, const TPoint2D& around,
                                  const std::vector<double>& headings, size_t count) {
  const CoarseMap map(grid, around);
  const size_t every = (scan.rays.size() + kMostBeams - 1) / kMostBeams;
  struct Place {
    int score;
    TPose2D pose;
  };
  std::vector<Place> places;
  for (const double heading : lattice(headings)) {
    // Beam ends in coarse cells from the robot, which stands in the middle of one.
    const GridPose frame({0, 0, heading}, scan, map.size());
    std::vector<CellIndex> ends;
    for (size_t i = 0; i < scan.rays.size(); i += every) {
      const ScanBeams::Ray& ray = scan.rays[i];
      const double range = ray.range / map.size();
      ends.push_back({static_cast<int>(std::floor(0.5 + frame.origin(ray).x + range * frame.dirX(ray))),
                      static_cast<int>(std::floor(0.5 + frame.origin(ray).y + range * frame.dirY(ray)))});
    }
    for (int y = 0; y < map.height(); ++y)
      for (int x = 0; x < map.width(); ++x) {
        if (!map.isFree(x, y)) continue;
        int score = 0;
        for (const CellIndex& end : ends) score += map.wall(x + end.x, y + end.y);
        if (score < static_cast<int>(ends.size())) continue;
        const TPoint2D at = map.centre(x, y);
        places.push_back({score, {at.x, at.y, mrpt::math::wrapToPi(heading)}});
      }
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.score > b.score; });
  std::vector<TPose2D> best;
  for (const auto& [score, pose] : places) {
    if (best.size() == count) break;
    const bool isNear = std::any_of(best.begin(), best.end(), [p = pose](const TPose2D& other) {
      return std::hypot(p.x - other.x, p.y - other.y) < kApart &&
             std::abs(mrpt::math::wrapToPi(p.phi - other.phi)) < kApartAngle;
    });
    if (!isNear) best.push_back(pose);
  }
  return best;
}

}  // namespace hybrid_slam
