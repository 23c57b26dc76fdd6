/// @file WallLines.h
/// @brief Groups faces that lie on one straight line, and estimates the line.
#pragma once

#include <vector>

#include "slam/lines/LineDatabase.h"
#include "slam/plan/GridFaces.h"

namespace hybrid_slam {

/// Faces on one line, which may have gaps.
struct WallLine {
  LineEstimate line;
  std::vector<Face> faces;
};

/// The stretches of a database line along which the grid is occupied. A line may be longer than what was seen
/// of it: merging takes the two farthest ends, also across doors.
std::vector<Face> facesOf(const DatabaseLine& line, const OccupancyGrid& grid);

/// Groups faces whose lines agree (squared Mahalanobis distance with 2 degrees of freedom below 13.8, the
/// 99.9 % quantile) and which are at most a door apart. The longest faces come first. A face is on the line
/// of a longer one that lies before or behind it, of the same side and less than a cell away.
/// @param cell  m, of the grid
std::vector<WallLine> wallLinesOf(std::vector<Face> faces, double cell);

}  // namespace hybrid_slam
