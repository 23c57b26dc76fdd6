#include "study/simulation/WallIndex.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hybrid_slam::simulation {

using mrpt::math::TPoint2D;

namespace {

constexpr double kMinCellSize = 0.5;  // m; about the length of the shortest walls, jambs and pillars
constexpr double kMaxCells = 4e5;

/// The axis-aligned box of a wall; for an arc, that of the full circle, which is conservative.
std::pair<TPoint2D, TPoint2D> boxOf(const Wall& wall) {
  if (wall.isArc())
    return {wall.centre - TPoint2D(wall.radius, wall.radius),
            wall.centre + TPoint2D(wall.radius, wall.radius)};
  return {{std::min(wall.start.x, wall.end.x), std::min(wall.start.y, wall.end.y)},
          {std::max(wall.start.x, wall.end.x), std::max(wall.start.y, wall.end.y)}};
}

}  // namespace

WallIndex::WallIndex(std::vector<Wall> walls) : walls_(std::move(walls)) {
  if (walls_.empty()) return;
  low_ = {kNoHit, kNoHit};
  high_ = {-kNoHit, -kNoHit};
  for (const Wall& wall : walls_) {
    const auto [low, high] = boxOf(wall);
    low_ = {std::min(low_.x, low.x), std::min(low_.y, low.y)};
    high_ = {std::max(high_.x, high.x), std::max(high_.y, high.y)};
  }
  const TPoint2D extent = high_ - low_;
  cellSize_ = std::max(
      {kMinCellSize, std::sqrt(extent.x * extent.y / kMaxCells), std::max(extent.x, extent.y) / kMaxCells});
  columns_ = static_cast<int>(extent.x / cellSize_) + 1;
  rows_ = static_cast<int>(extent.y / cellSize_) + 1;
  cells_.resize(static_cast<size_t>(columns_) * rows_);
  for (size_t i = 0; i < walls_.size(); ++i) {
    const auto [low, high] = boxOf(walls_[i]);
    // One more cell on each side: a wall on the border of two cells belongs to both.
    const int lastColumn = std::min(columns_ - 1, columnOf(high.x) + 1);
    const int lastRow = std::min(rows_ - 1, rowOf(high.y) + 1);
    for (int row = std::max(0, rowOf(low.y) - 1); row <= lastRow; ++row)
      for (int column = std::max(0, columnOf(low.x) - 1); column <= lastColumn; ++column)
        if (mayTouch(walls_[i], column, row)) cells_[cellNumber(column, row)].push_back(static_cast<int>(i));
  }
}

int WallIndex::columnOf(double x) const {
  return static_cast<int>(std::clamp(std::floor((x - low_.x) / cellSize_), 0.0, columns_ - 1.0));
}

int WallIndex::rowOf(double y) const {
  return static_cast<int>(std::clamp(std::floor((y - low_.y) / cellSize_), 0.0, rows_ - 1.0));
}

/// Returns whether the wall may touch the cell. No false negatives: tests the cell's circumscribed circle.
bool WallIndex::mayTouch(const Wall& wall, int column, int row) const {
  const TPoint2D centre(low_.x + (column + 0.5) * cellSize_, low_.y + (row + 0.5) * cellSize_);
  return wall.distance(centre) <= cellSize_ * M_SQRT1_2 + 1e-6;
}

double WallIndex::rayDistance(const TPoint2D& origin, const TPoint2D& direction, double maxRange) const {
  if (walls_.empty()) return kNoHit;
  // The part of the ray inside the grid, by slabs.
  double enter = 0, leave = maxRange;
  for (const int axis : {0, 1}) {
    const double o = origin[axis] - low_[axis], d = direction[axis];
    const double extent = (axis == 0 ? columns_ : rows_) * cellSize_;
    if (std::abs(d) < 1e-15) {
      if (o < -1e-9 || o > extent + 1e-9) return kNoHit;
      continue;
    }
    enter = std::max(enter, std::min(-o / d, (extent - o) / d));
    leave = std::min(leave, std::max(-o / d, (extent - o) / d));
  }
  if (enter > leave + 1e-9) return kNoHit;

  const TPoint2D first = origin + direction * enter;
  int column = columnOf(first.x), row = rowOf(first.y);
  const int columnStep = direction.x > 0 ? 1 : -1, rowStep = direction.y > 0 ? 1 : -1;
  const auto crossing = [this](double o, double low, double d, int cell, int step) {
    if (std::abs(d) < 1e-15) return kNoHit;
    return (low + (cell + (step > 0 ? 1 : 0)) * cellSize_ - o) / d;
  };
  double nextColumn = crossing(origin.x, low_.x, direction.x, column, columnStep);
  double nextRow = crossing(origin.y, low_.y, direction.y, row, rowStep);
  const double columnLength = cellSize_ / std::max(std::abs(direction.x), 1e-15);
  const double rowLength = cellSize_ / std::max(std::abs(direction.y), 1e-15);

  double nearest = kNoHit;
  while (true) {
    for (const int i : cells_[cellNumber(column, row)])
      nearest = std::min(nearest, simulation::rayDistance(walls_[i], origin, direction));
    const double exit = std::min(nextColumn, nextRow);
    // The margin keeps a farther hit from replacing one on the border of two cells.
    if (nearest <= exit - 1e-9 || exit > leave + 1e-9) break;
    if (nextColumn < nextRow) {
      column += columnStep;
      nextColumn += columnLength;
      if (column < 0 || column >= columns_) break;
    } else {
      row += rowStep;
      nextRow += rowLength;
      if (row < 0 || row >= rows_) break;
    }
  }
  return nearest <= maxRange ? nearest : kNoHit;
}

double WallIndex::nearestDistance(const TPoint2D& p) const {
  if (walls_.empty()) return kNoHit;
  const int column = columnOf(p.x), row = rowOf(p.y);
  double nearest = kNoHit;
  // Square rings of cells around p; every wall of ring k and beyond is at least (k - 1) cells away, even if p
  // is outside the grid and the rings are centred on the nearest cell.
  for (int ring = 0; ring < std::max(columns_, rows_) && (ring - 1) * cellSize_ <= nearest; ++ring)
    for (int r = std::max(0, row - ring); r <= std::min(rows_ - 1, row + ring); ++r) {
      const bool whole = std::abs(r - row) == ring;
      for (int c = column - ring; c <= column + ring; c += whole ? 1 : std::max(1, 2 * ring))
        if (c >= 0 && c < columns_)
          for (const int i : cells_[cellNumber(c, r)]) nearest = std::min(nearest, walls_[i].distance(p));
    }
  return nearest;
}

}  // namespace hybrid_slam::simulation
