#include "study/comparison/PlanView.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hybrid_slam::comparison {

using mrpt::math::TPoint2D;

void PlanView::drawWalls(Svg& svg, const simulation::FloorPlan& plan, const std::string& style) const {
  for (const simulation::Wall& wall : plan.walls()) {
    std::vector<Point> points;
    const int pieces = wall.isArc() ? 24 : 1;
    for (int i = 0; i <= pieces; ++i) points.push_back(pixel(wall.pointAt(static_cast<double>(i) / pieces)));
    svg.polyline(points, style);
  }
}

void PlanView::drawScaleBar(Svg& svg, Point start, double longest) const {
  double metres = std::pow(10, std::floor(std::log10(longest / scale_)));
  for (const double factor : {5.0, 2.0})
    if (metres * factor * scale_ <= longest) {
      metres *= factor;
      break;
    }
  const Point end{start.x + metres * scale_, start.y};
  svg.line(start, end, "stroke:#333;stroke-width:2");
  svg.text({end.x + 6, end.y + 4}, shortNumber(metres) + " m");
}

std::string plotCellsOverWalls(const std::vector<TPoint2D>& cells, double resolution,
                               const simulation::FloorPlan& plan, const std::string& title) {
  // Okabe & Ito's colours; a cell's own quantisation and the laser's noise stay below the first distance.
  struct Class {
    double farthest;  // m
    const char *style, *name;
  };
  static constexpr std::array<Class, 3> kClasses{{{0.1, "fill:#000", "up to 0.1 m"},
                                                  {0.3, "fill:#e69f00", "up to 0.3 m"},
                                                  {1e9, "fill:#d55e00", "farther"}}};
  constexpr double kMargin = 24, kSide = 480, kAround = 2;
  const TPoint2D low = plan.lowerLeft() - TPoint2D(kAround, kAround);
  const TPoint2D high = plan.upperRight() + TPoint2D(kAround, kAround), extent = high - low;
  const PlanView view({low.x, high.y}, {0, kMargin}, kSide / std::max(extent.x, extent.y));

  std::array<std::vector<Point>, kClasses.size()> squares;
  for (const TPoint2D& cell : cells) {
    if (cell.x < low.x || cell.y < low.y || cell.x > high.x || cell.y > high.y) continue;
    const double distance = plan.distanceToNearestWall(cell);
    size_t c = 0;
    while (distance > kClasses[c].farthest) ++c;
    squares[c].push_back(view.pixel(cell));
  }
  Svg svg(std::max(extent.x * view.scale(), 320.0), extent.y * view.scale() + 2 * kMargin);
  svg.text({0, 15}, title, Anchor::start, "font-weight:bold");
  view.drawWalls(svg, plan, "stroke:#56b4e9;stroke-width:0.7");
  const double side = std::max(resolution * view.scale(), 1.0);
  const double bottom = svg.height() - 10;
  view.drawScaleBar(svg, {0, bottom}, 80);
  for (size_t c = 0; c < kClasses.size(); ++c) {
    svg.squares(squares[c], side, kClasses[c].style);
    const Point key{130 + 110 * static_cast<double>(c), bottom};
    svg.squares({key}, 8, kClasses[c].style);
    svg.text({key.x + 8, key.y + 4}, kClasses[c].name);
  }
  return svg.str("occupied cells over the walls, " + title);
}

}  // namespace hybrid_slam::comparison
