#include "run/MapRaster.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hybrid_slam::run {

using mrpt::maps::COccupancyGridMap2D;

MapRaster::MapRaster(const COccupancyGridMap2D& grid, const files::Trajectory& trajectory) {
  findKnownCells(grid);
  includeRobot(grid, trajectory);
  const auto rounded = [](double metres) { return std::round(metres * 1e5) / 1e5; };  // MRPT uses floats
  cell_ = rounded(grid.getResolution());
  xMin_ = rounded(grid.getXMin() + window_.x0 * static_cast<double>(grid.getResolution()));
  yMin_ = rounded(grid.getYMin() + window_.y0 * static_cast<double>(grid.getResolution()));
  addCells(grid);
  addDriven(trajectory);
}

/// Finds the columns and rows with known cells, plus a margin; the whole grid if there are none.
void MapRaster::findKnownCells(const COccupancyGridMap2D& grid) {
  constexpr int kMargin = 10;
  const int width = static_cast<int>(grid.getSizeX()), height = static_cast<int>(grid.getSizeY());
  Window known{width, height, -1, -1};
  for (int y = 0; y < height; ++y) {
    const auto* row = grid.getRow(y);
    for (int x = 0; x < width; ++x)
      if (row[x] != 0)
        known = {std::min(known.x0, x), std::min(known.y0, y), std::max(known.x1, x), std::max(known.y1, y)};
  }
  if (known.x1 < 0) known = {0, 0, width - 1, height - 1};
  window_ = {std::max(known.x0 - kMargin, 0), std::max(known.y0 - kMargin, 0),
             std::min(known.x1 + kMargin, width - 1), std::min(known.y1 + kMargin, height - 1)};
}

/// Extends the window to the robot, which may start outside its laser's view. Ignores poses far from the map
/// as wrong.
void MapRaster::includeRobot(const COccupancyGridMap2D& grid, const files::Trajectory& trajectory) {
  constexpr double kFar = 2;  // m
  const double cell = grid.getResolution(), radius = kRobotRadius / cell, far = kFar / cell;
  const Window known = window_;
  for (const files::StampedPose& stamped : trajectory) {
    const double x = (stamped.pose.x - grid.getXMin()) / cell, y = (stamped.pose.y - grid.getYMin()) / cell;
    if (!(x > known.x0 - far && x < known.x1 + far && y > known.y0 - far && y < known.y1 + far)) continue;
    window_.x0 = std::min(window_.x0, static_cast<int>(std::floor(x - radius)));
    window_.x1 = std::max(window_.x1, static_cast<int>(std::floor(x + radius)));
    window_.y0 = std::min(window_.y0, static_cast<int>(std::floor(y - radius)));
    window_.y1 = std::max(window_.y1, static_cast<int>(std::floor(y + radius)));
  }
}

void MapRaster::addCells(const COccupancyGridMap2D& grid) {
  using Cell = COccupancyGridMap2D::cellType;
  static_assert(sizeof(Cell) == 1);
  std::array<uint8_t, 256> values;
  for (int logOdds = -128; logOdds < 128; ++logOdds) {
    const bool isOccupied =
        1 - COccupancyGridMap2D::l2p(static_cast<Cell>(logOdds)) > static_cast<float>(kOccupiedThreshold);
    // Free by the log-odds, since MRPT's table of probabilities has no exact half.
    values[static_cast<uint8_t>(logOdds)] = isOccupied ? kOccupied : logOdds > 0 ? kFree : kUnknown;
  }
  cells_.assign(static_cast<size_t>(width()) * static_cast<size_t>(height()), kUnknown);
  const int first = std::max(window_.x0, 0),
            last = std::min(window_.x1, static_cast<int>(grid.getSizeX()) - 1);
  for (int y = std::max(window_.y0, 0); y <= std::min(window_.y1, static_cast<int>(grid.getSizeY()) - 1);
       ++y) {
    const Cell* const from = grid.getRow(y);
    uint8_t* const to = &cells_[index(0, window_.y1 - y)];
    for (int x = first; x <= last; ++x) to[x - window_.x0] = values[static_cast<uint8_t>(from[x])];
  }
}

/// Between two poses less than 1 m apart the robot drove straight ahead; up to 2 m it did if no cell on the
/// line is occupied, since sparse logs have a scan per metre or two. Farther apart there is a gap in the log.
void MapRaster::addDriven(const files::Trajectory& trajectory) {
  constexpr double kNear = 1, kGap = 2, kStep = 0.02, kStanding = 0.005;  // m
  double x = 0, y = 0;                                                    // of the last place that was added
  for (size_t i = 0; i < trajectory.size(); ++i) {
    const auto& to = trajectory[i].pose;
    const double distance = std::hypot(to.x - x, to.y - y);
    if (i > 0 && distance < kStanding) continue;
    const bool isStraight = i > 0 && (distance < kNear || (distance < kGap && isClear(x, y, to.x, to.y)));
    const int steps = isStraight ? static_cast<int>(std::ceil(distance / kStep)) : 1;
    for (int k = 1; k <= steps; ++k) addRobot(x + (to.x - x) * k / steps, y + (to.y - y) * k / steps);
    x = to.x, y = to.y;
  }
}

/// Returns whether no cell on a line is occupied (m, map frame).
bool MapRaster::isClear(double x0, double y0, double x1, double y1) const {
  const double column = (x0 - xMin_) / cell_, row = (y0 - yMin_) / cell_;  // row: from the south
  const double columns = (x1 - x0) / cell_, rows = (y1 - y0) / cell_;
  const int steps = static_cast<int>(std::ceil(4 * std::hypot(columns, rows)));
  for (int k = 0; k <= steps; ++k) {
    const double x = column + columns * k / steps, y = row + rows * k / steps;
    if (x >= 0 && y >= 0 && x < width() && y < height() &&
        at(static_cast<int>(x), height() - 1 - static_cast<int>(y)) == kOccupied)
      return false;
  }
  return true;
}

void MapRaster::addRobot(double x, double y) {
  const double east = (x - xMin_) / cell_, south = height() - (y - yMin_) / cell_,
               radius = kRobotRadius / cell_;
  if (!(east > -radius && east < width() + radius && south > -radius && south < height() + radius)) return;
  const auto within = [](double cells, int size) {
    return std::clamp(static_cast<int>(std::floor(cells)), 0, size - 1);
  };
  for (int row = within(south - radius, height()); row <= within(south + radius, height()); ++row)
    for (int column = within(east - radius, width()); column <= within(east + radius, width()); ++column)
      if (uint8_t& cell = cells_[index(column, row)];
          cell == kUnknown && std::hypot(column + 0.5 - east, row + 0.5 - south) <= radius)
        cell = kFree;
}

uint8_t MapRaster::at(int column, int row, int side) const {
  bool isFree = false;
  for (int j = row; j < std::min(row + side, height()); ++j)
    for (int i = column; i < std::min(column + side, width()); ++i) {
      const uint8_t value = at(i, j);
      if (value == kOccupied) return kOccupied;
      isFree |= value == kFree;
    }
  return isFree ? kFree : kUnknown;
}

}  // namespace hybrid_slam::run
