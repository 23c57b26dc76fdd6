/// @file MapRaster.h
/// @brief A map as the pixels of a picture.
#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>

#include <cstdint>
#include <vector>

#include "files/Trajectory.h"

namespace hybrid_slam::run {

/// A usual radius (m). Cells that the robot drove over are free even where its laser could not see them.
constexpr double kRobotRadius = 0.25;

/// The known part of a grid, and the cells that the robot drove over, in the three values of ROS's
/// map_server. Column 0 is in the west, row 0 in the north.
class MapRaster {
 public:
  static constexpr uint8_t kOccupied = 0, kFree = 254, kUnknown = 205;
  /// Occupancies above this are occupied: two hits with the default `[grid] p_hit`.
  static constexpr double kOccupiedThreshold = 0.65;

  MapRaster(const mrpt::maps::COccupancyGridMap2D& grid, const files::Trajectory& trajectory);

  int width() const { return window_.x1 - window_.x0 + 1; }   ///< cells
  int height() const { return window_.y1 - window_.y0 + 1; }  ///< cells
  double cell() const { return cell_; }                       ///< m
  double left() const { return xMin_; }                       ///< m, map frame, of the western edge
  double bottom() const { return yMin_; }                     ///< m, map frame, of the southern edge
  /// Returns the value of a cell: occupied by the threshold; free if beams crossed it more often than they
  /// hit it, or if the robot drove over it.
  uint8_t at(int column, int row) const { return cells_[index(column, row)]; }
  /// Returns the values of a row, `width()` of them.
  const uint8_t* row(int row) const { return &cells_[index(0, row)]; }
  /// Returns the value of `side` x `side` cells: occupied if any is, else free if any is, so that thin walls
  /// remain.
  uint8_t at(int column, int row, int side) const;

 private:
  struct Window {
    int x0, y0, x1, y1;  ///< both ends included
  };
  size_t index(int column, int row) const {
    return static_cast<size_t>(row) * static_cast<size_t>(width()) + static_cast<size_t>(column);
  }
  void findKnownCells(const mrpt::maps::COccupancyGridMap2D& grid);
  void includeRobot(const mrpt::maps::COccupancyGridMap2D& grid, const files::Trajectory& trajectory);
  void addCells(const mrpt::maps::COccupancyGridMap2D& grid);
  void addDriven(const files::Trajectory& trajectory);
  void addRobot(double x, double y);
  bool isClear(double x0, double y0, double x1, double y1) const;

  Window window_{};  ///< cells of the grid; partly outside of it where the robot was
  double cell_, xMin_, yMin_;
  std::vector<uint8_t> cells_;  ///< row by row from the north
};

}  // namespace hybrid_slam::run
