#include "run/MapRaster.h"

#include <algorithm>
#include <cmath>

namespace hybrid_slam::run {

using mrpt::maps::COccupancyGridMap2D;

MapRaster::MapRaster(const COccupancyGridMap2D& grid, const files::Trajectory& trajectory) : grid_(grid) {
  findKnownCells();
  includeRobot(trajectory);
  const auto rounded = [](double metres) { return std::round(metres * 1e5) / 1e5; };  // MRPT uses floats
  cell_ = rounded(grid.getResolution());
  xMin_ = rounded(grid.getXMin() + window_.x0 * static_cast<double>(grid.getResolution()));
  yMin_ = rounded(grid.getYMin() + window_.y0 * static_cast<double>(grid.getResolution()));
  isDriven_.resize(static_cast<size_t>(width()) * static_cast<size_t>(height()));
  addDriven(trajectory);
}

/// Finds the columns and rows with known cells, plus a margin; the whole grid if there are none.
void MapRaster::findKnownCells() {
  constexpr int kMargin = 10;
  const int width = static_cast<int>(grid_.getSizeX()), height = static_cast<int>(grid_.getSizeY());
  Window known{width, height, -1, -1};
  for (int y = 0; y < height; ++y) {
    const auto* row = grid_.getRow(y);
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
void MapRaster::includeRobot(const files::Trajectory& trajectory) {
  constexpr double kFar = 2;  // m
  const double cell = grid_.getResolution(), radius = kRobotRadius / cell, far = kFar / cell;
  const Window known = window_;
  for (const files::StampedPose& stamped : trajectory) {
    const double x = (stamped.pose.x - grid_.getXMin()) / cell, y = (stamped.pose.y - grid_.getYMin()) / cell;
    if (!(x > known.x0 - far && x < known.x1 + far && y > known.y0 - far && y < known.y1 + far)) continue;
    window_.x0 = std::min(window_.x0, static_cast<int>(std::floor(x - radius)));
    window_.x1 = std::max(window_.x1, static_cast<int>(std::floor(x + radius)));
    window_.y0 = std::min(window_.y0, static_cast<int>(std::floor(y - radius)));
    window_.y1 = std::max(window_.y1, static_cast<int>(std::floor(y + radius)));
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
  const double column = (x0 - grid_.getXMin()) / cell_, row = (y0 - grid_.getYMin()) / cell_;
  const double columns = (x1 - x0) / cell_, rows = (y1 - y0) / cell_;
  const int steps = static_cast<int>(std::ceil(4 * std::hypot(columns, rows)));
  for (int k = 0; k <= steps; ++k)
    if (isOccupied(column + columns * k / steps, row + rows * k / steps)) return false;
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
      if (std::hypot(column + 0.5 - east, row + 0.5 - south) <= radius)
        isDriven_[static_cast<size_t>(row) * static_cast<size_t>(width()) + static_cast<size_t>(column)] =
            true;
}

bool MapRaster::isInGrid(double x, double y) const {
  return x >= 0 && y >= 0 && x < static_cast<double>(grid_.getSizeX()) &&
         y < static_cast<double>(grid_.getSizeY());
}

bool MapRaster::isOccupied(double x, double y) const {
  return isInGrid(x, y) &&
         1 - grid_.getCell(static_cast<int>(x), static_cast<int>(y)) > static_cast<float>(kOccupiedThreshold);
}

uint8_t MapRaster::at(int column, int row) const {
  const int x = window_.x0 + column, y = window_.y1 - row;
  if (isOccupied(x, y)) return kOccupied;
  // The log-odds, since MRPT's table of probabilities has no exact half.
  if (isInGrid(x, y) && grid_.getRow(y)[x] > 0) return kFree;
  const size_t i = static_cast<size_t>(row) * static_cast<size_t>(width()) + static_cast<size_t>(column);
  return isDriven_[i] ? kFree : kUnknown;
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
