#include "study/comparison/PlanPlots.h"

#include <algorithm>
#include <cmath>

#include "study/comparison/ReportText.h"

namespace hybrid_slam::comparison {

using mrpt::math::TPoint2D;

namespace {

double length(const files::Trajectory& trajectory) {
  double sum = 0;
  for (size_t i = 1; i < trajectory.size(); ++i) sum += (trajectory[i].pose - trajectory[i - 1].pose).norm();
  return sum;
}

/// Adds the first pose, the last, and between them those at least `step` (m) from the previous one.
void addThinned(DataBlock& block, const files::Trajectory& trajectory, double step) {
  const files::StampedPose* drawn = nullptr;
  for (const files::StampedPose& p : trajectory) {
    if (drawn && &p != &trajectory.back() && (p.pose - drawn->pose).norm() < step) continue;
    block.add({p.pose.x, p.pose.y});
    drawn = &p;
  }
  block.add({});
}

/// Width and height of a picture whose plot is `side` pixels long at most, with room for axes and title.
Plot sized(const std::string& description, const TPoint2D& extent, double side) {
  const double scale = side / std::max(extent.x, extent.y);
  return {description, static_cast<int>(std::max(extent.x * scale, 240.0) + 70),
          static_cast<int>(std::max(extent.y * scale, 80.0) + 90), ""};
}

}  // namespace

std::string wallBlock(const simulation::BuildingPlan& plan) {
  DataBlock walls("walls");
  for (const simulation::Wall& wall : plan.walls()) {
    const int pieces = wall.isArc() ? 24 : 1;
    for (int i = 0; i <= pieces; ++i) {
      const TPoint2D p = wall.pointAt(static_cast<double>(i) / pieces);
      walls.add({p.x, p.y});
    }
    walls.add({});
  }
  return walls.script();
}

std::string planFrame(const std::string& title, const TPoint2D& low, const TPoint2D& high) {
  const auto range = [](double from, double to) {
    return " [" + shortNumber(from, 6) + ":" + shortNumber(to, 6) + "]\n";
  };
  return "set title " + gnuplotText(title) + " offset 0,-0.3\nunset grid\nset size ratio -1\n" +
         "set lmargin 8\nset rmargin 1.5\nset tmargin 1.7\nset bmargin 3\n" + "set xrange" +
         range(low.x, high.x) + "set yrange" + range(low.y, high.y) +
         "set xlabel 'x (m)' offset 0,0.5\nset ylabel 'y (m)' offset 1,0\n";
}

Plot plotTrajectories(const std::string& group, int colour,
                      const std::vector<files::Trajectory>& trajectories, const files::Trajectory& reference,
                      const simulation::BuildingPlan* plan) {
  TPoint2D low(INFINITY, INFINITY), high(-INFINITY, -INFINITY);
  const auto take = [&](double x, double y) {
    low = {std::min(low.x, x), std::min(low.y, y)};
    high = {std::max(high.x, x), std::max(high.y, y)};
  };
  double total = 0;  // m
  for (const files::Trajectory& trajectory : trajectories) {
    for (const files::StampedPose& p : trajectory) take(p.pose.x, p.pose.y);
    total += length(trajectory);
  }
  for (const files::StampedPose& p : reference) take(p.pose.x, p.pose.y);
  if (plan) take(plan->lowerLeft().x, plan->lowerLeft().y), take(plan->upperRight().x, plan->upperRight().y);
  if (low.x > high.x) return {};
  const double side = std::max({high.x - low.x, high.y - low.y, 1.0}), margin = 0.03 * side;
  low -= TPoint2D(margin, margin), high += TPoint2D(margin, margin);

  constexpr double kSide = 400, kPoints = 4000;
  const double step = std::max(side / kSide, (total + length(reference)) / kPoints);
  DataBlock runs("runs"), truth("truth");
  for (const files::Trajectory& trajectory : trajectories) addThinned(runs, trajectory, step);
  addThinned(truth, reference, step);
  Plot plot = sized("trajectories of " + group, high - low, kSide);
  plot.script =
      planFrame(group, low, high) + runs.script() + (plan ? wallBlock(*plan) : "") +
      (reference.empty() ? "" : truth.script()) + "plot " +
      (plan ? "$walls with lines linecolor rgb '#bbbbbb' notitle, " : "") +
      "$runs with lines linecolor rgb " + std::to_string(0x66000000 + colour) + " notitle" +
      (reference.empty() ? ""
                         : ", $truth with lines linewidth 1.4 dashtype 2 linecolor rgb 'black' notitle") +
      "\n";
  return plot;
}

Plot plotCellsOverWalls(const std::vector<TPoint2D>& cells, double resolution,
                        const simulation::BuildingPlan& plan, const std::string& title) {
  constexpr double kSide = 480, kAround = 2;
  const TPoint2D low = plan.lowerLeft() - TPoint2D(kAround, kAround);
  const TPoint2D high = plan.upperRight() + TPoint2D(kAround, kAround), extent = high - low;
  const double pixel = std::max(resolution, std::max(extent.x, extent.y) / kSide);
  const auto columns = static_cast<size_t>(std::ceil(extent.x / pixel)),
             rows = static_cast<size_t>(std::ceil(extent.y / pixel));

  // A cell's own quantisation and the laser's noise stay below the first distance.
  std::vector<std::vector<double>> image(rows, std::vector<double>(columns, NAN));
  for (const TPoint2D& cell : cells) {
    if (cell.x <= low.x || cell.y <= low.y || cell.x >= high.x || cell.y >= high.y) continue;
    const double distance = plan.distanceToNearestWall(cell);
    const double shown = distance > 0.3 ? 2 : distance > 0.1 ? 1 : 0;
    double& at =
        image[static_cast<size_t>((cell.y - low.y) / pixel)][static_cast<size_t>((cell.x - low.x) / pixel)];
    at = std::isnan(at) ? shown : std::max(at, shown);
  }
  DataBlock block("cells");
  for (const auto& row : image) block.add(row);

  const auto key = [](const char* colour, const char* name) {
    return std::string(", NaN with points pointtype 5 linecolor rgb '") + colour + "' title '" + name + "'";
  };
  const auto pixels = [&](char column, double from) {
    return "(" + shortNumber(from + pixel / 2, 8) + "+" + shortNumber(pixel, 8) + "*$" + column + ")";
  };
  Plot plot = sized("occupied cells over the walls, " + title, extent, kSide);
  plot.height += 20;  // the key
  plot.script =
      planFrame(title, low, high) + wallBlock(plan) + block.script() +
      "set palette defined (0 '#000000', 1 '#e69f00', 2 '#d55e00')\nset cbrange [0:2]\nunset colorbox\n"
      "set bmargin 4.5\nset key below center horizontal reverse Left samplen 1\n"
      "plot $walls with lines linewidth 0.7 linecolor rgb '#56b4e9' notitle, $cells matrix using " +
      pixels('1', low.x) + ":" + pixels('2', low.y) + ":3 with image notitle" +
      key("#000000", "up to 0.1 m") + key("#e69f00", "up to 0.3 m") + key("#d55e00", "farther") + "\n";
  return plot;
}

}  // namespace hybrid_slam::comparison
