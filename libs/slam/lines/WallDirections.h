/// @file WallDirections.h
/// @brief Directions of walls, modulo 90 deg: of a building, of each of its wings and of a scan.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "slam/lines/LineDatabase.h"

namespace hybrid_slam {

/// A line's weight as evidence of its direction, m: length x min(count, 20). The cap keeps an old wall from
/// outweighing all others.
inline double evidence(const DatabaseLine& line) { return line.length * std::min(line.count, 20); }

/// The direction, modulo 90 deg, to which the lines are parallel or perpendicular, rad in (-pi/4, pi/4]:
/// atan2(sum w sin 4 theta, sum w cos 4 theta) / 4, w the evidence of each line. Empty if there is no line or
/// no dominating direction.
std::optional<double> directionModuloRightAngle(const std::vector<DatabaseLine>& lines);
/// The same for observed lines, whose evidence counts each as observed once.
std::optional<double> directionModuloRightAngle(const std::vector<LineSegment>& seen);

/// The angle modulo 90 deg, rad in [-pi/4, pi/4].
double wrapToRightAngle(double angle);
/// wrapToRightAngle(a - b) for wrapped angles; much faster.
inline double rightAngleDifference(double a, double b) {
  const double d = a - b;
  return d > M_PI / 4 ? d - M_PI / 2 : d < -M_PI / 4 ? d + M_PI / 2 : d;
}

/// Sets each line's `direction`: the mean of the directions, modulo 90 deg, within `window` (rad) of its own,
/// weighted by evidence x (1 - (difference / window)^2): one mean-shift step with the Epanechnikov kernel
/// (Comaniciu & Meer 2002). Building wings whose directions differ by more than the window stay separate. If
/// `window` is 0, every line keeps its own direction.
void setDirections(std::vector<DatabaseLine>& lines, double window);

/// The headings (rad) of a robot at which the walls it sees are parallel or perpendicular to those of the
/// map; empty if either has no dominating direction.
/// @param seen  robot frame
std::vector<double> alignedHeadings(const std::vector<LineSegment>& seen, const LineDatabase& map);

}  // namespace hybrid_slam
