/// @file PlanView.h
/// @brief Pictures in the floor plan's frame: walls, a scale bar, and a map's cells over the walls (Fig. 6).
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <string>
#include <vector>

#include "study/comparison/Svg.h"
#include "study/simulation/FloorPlan.h"

namespace hybrid_slam::comparison {

/// Metres to pixels, y upwards.
class PlanView {
 public:
  /// @param corner  m, the upper left one of what is shown; @param at  where it lies, pixels
  /// @param scale   pixels for a metre
  PlanView(const mrpt::math::TPoint2D& corner, Point at, double scale)
      : corner_(corner), at_(at), scale_(scale) {}

  Point pixel(const mrpt::math::TPoint2D& p) const {
    return {at_.x + (p.x - corner_.x) * scale_, at_.y + (corner_.y - p.y) * scale_};
  }
  double scale() const { return scale_; }
  void drawWalls(Svg& svg, const simulation::FloorPlan& plan, const std::string& style) const;
  /// A bar of 1, 2 or 5 times a power of ten metres, at most `longest` pixels long, with its length.
  void drawScaleBar(Svg& svg, Point start, double longest) const;

 private:
  mrpt::math::TPoint2D corner_;
  Point at_;
  double scale_;
};

/// The paper's Fig. 6: the centres of a map's occupied cells over the walls, coloured by their distance to
/// the nearest wall; cells more than 2 m outside of the plan are left out.
/// @param cells       m, in the plan's frame
/// @param resolution  m, side of a cell
std::string plotCellsOverWalls(const std::vector<mrpt::math::TPoint2D>& cells, double resolution,
                               const simulation::FloorPlan& plan, const std::string& title);

}  // namespace hybrid_slam::comparison
