/// @file PlanLines.h
/// @brief Collects the walls of a floor plan that is read, within bounds.
#pragma once

#include <string>
#include <vector>

#include "slam/plan/PlanLine.h"

namespace hybrid_slam::run {

/// The walls of one file, which must be of the size of a building.
class PlanLines {
 public:
  /// @param file  named in errors
  explicit PlanLines(const std::string& file) : file_(file) {}

  /// Adds a wall; ends in m. Walls of at most 1 um are left out.
  /// @throws InputError for a coordinate beyond 1e6 m, over a million walls, or as checkPlanLength
  void add(const mrpt::math::TPoint2D& start, const mrpt::math::TPoint2D& end);

  const std::vector<PlanLine>& all() const { return all_; }

 private:
  const std::string& file_;
  std::vector<PlanLine> all_;
  double length_ = 0;  // m
};

/// Reads the walls of a DXF: LINE, LWPOLYLINE, POLYLINE, ARC and CIRCLE, in the unit of $INSUNITS (0 or none:
/// m). Arcs become chords of at most 10 deg. Blocks (symbols of doors, furniture) and the layer OPENINGS are
/// left out.
/// @throws std::runtime_error if it is not an ASCII DXF or has an unknown unit; InputError as PlanLines::add
void readPlanDxf(const std::string& text, PlanLines& lines);

}  // namespace hybrid_slam::run
