#include "study/comparison/PlanPlots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hybrid_slam::comparison {
namespace {

using mrpt::math::TPoint2D;
using testing::HasSubstr;
using testing::Not;

/// The text between a block's first and last line.
std::string block(const std::string& script, const std::string& name) {
  const std::string head = "$" + name + " << EOD\n";
  const size_t begin = script.find(head), end = script.find("EOD\n", begin + head.size());
  return begin == std::string::npos ? "" : script.substr(begin + head.size(), end - begin - head.size());
}

std::string drawn(const Plot& plot) {
  Gnuplot gnuplot;
  const std::string svg = gnuplot.draw({plot});
  EXPECT_EQ(gnuplot.error(), "");
  return svg;
}

TEST(PlanPlots, WallsAreLines) {
  const simulation::BuildingPlan plan(
      {simulation::Wall::straight({0, 0}, {10, 0}), simulation::Wall::arc({5, 1}, 0.5, 0, 6)});
  const std::string walls = block(wallBlock(plan), "walls");
  EXPECT_THAT(walls, HasSubstr("0 0\n10 0\n\n5.5 1\n"));
  EXPECT_EQ(std::count(walls.begin(), walls.end(), '\n'), 3 + 26);
}

TEST(PlanPlots, TrajectoriesLieOverReferenceAndPlan) {
  files::Trajectory way;
  for (int i = 0; i < 50; ++i) way.push_back({0.1 * i, {0.2 * i, 1, 0}});
  const simulation::BuildingPlan plan(
      {simulation::Wall::straight({0, 0}, {10, 0}), simulation::Wall::straight({0, 2}, {10, 2})});
  const Plot plot = plotTrajectories("hybrid-20", 0xd55e00, {way, way}, way, &plan);
  EXPECT_EQ(plot.description, "trajectories of hybrid-20");
  EXPECT_THAT(plot.script, HasSubstr("set size ratio -1\n"));
  EXPECT_THAT(plot.script, HasSubstr("plot $walls "));
  EXPECT_THAT(plot.script, HasSubstr(", $truth with lines"));
  EXPECT_THAT(block(plot.script, "runs"), HasSubstr("0 1\n0.2 1\n"));
  EXPECT_THAT(drawn(plot), HasSubstr(">x (m)</text>"));
  const std::string alone = plotTrajectories("general-20", 0, {way}, {}, nullptr).script;
  EXPECT_THAT(alone, Not(HasSubstr("$truth")));
  EXPECT_THAT(alone, Not(HasSubstr("$walls")));
  EXPECT_EQ(plotTrajectories("general-20", 0, {}, {}, nullptr).script, "");
}

TEST(PlanPlots, AStationaryRobotHasAPlot) {
  EXPECT_NE(drawn(plotTrajectories("general-20", 0, {{{0, {3, 4, 0}}, {1, {3, 4, 1}}}}, {}, nullptr)), "");
}

TEST(PlanPlots, LongTrajectoriesAreThinned) {
  files::Trajectory circles;
  for (int i = 0; i < 20000; ++i)
    circles.push_back({0.1 * i, {5 * std::cos(0.01 * i), 5 * std::sin(0.01 * i), 0}});
  const Plot plot =
      plotTrajectories("hybrid-20", 0, std::vector<files::Trajectory>(10, circles), circles, nullptr);
  const std::string runs = block(plot.script, "runs");
  EXPECT_LT(std::count(runs.begin(), runs.end(), '\n'), 4100);
  EXPECT_GT(std::count(runs.begin(), runs.end(), '\n'), 2000);
  EXPECT_LT(drawn(plot).size(), 120000u);
}

TEST(CellsOverWalls, AreColouredByTheirDistance) {
  const simulation::BuildingPlan plan(
      {simulation::Wall::straight({0, 0}, {10, 0}), simulation::Wall::straight({0, 10}, {10, 10})});
  // Two cells are on a wall, one is 0.2 m off, one 1 m off, and one far outside the plan.
  const Plot plot =
      plotCellsOverWalls({{1, 0}, {2, 0.05}, {3, 0.2}, {4, 1}, {5, 99}}, 0.05, plan, "hybrid-20: a < b");
  EXPECT_EQ(plot.description, "occupied cells over the walls, hybrid-20: a < b");
  const std::string cells = block(plot.script, "cells");
  EXPECT_EQ(std::count(cells.begin(), cells.end(), '0'), 2);
  EXPECT_EQ(std::count(cells.begin(), cells.end(), '1'), 1);
  EXPECT_EQ(std::count(cells.begin(), cells.end(), '2'), 1);
  EXPECT_EQ(std::count(cells.begin(), cells.end(), '\n'), 280);  // 14 m of 0.05 m
  const std::string svg = drawn(plot);
  EXPECT_THAT(svg, HasSubstr("data:image/png;base64,"));
  EXPECT_THAT(svg, HasSubstr(">up to 0.3 m</text>"));
}

TEST(CellsOverWalls, ThePictureOfALargeMapIsSmall) {
  std::vector<simulation::Wall> walls;
  for (double y = 0; y <= 200; y += 10) walls.push_back(simulation::Wall::straight({0, y}, {300, y}));
  const simulation::BuildingPlan plan(walls);
  std::vector<TPoint2D> cells;
  for (int i = 0; i < 20000; ++i) cells.push_back({std::fmod(3.7 * i, 300), std::fmod(1.1 * i, 200)});
  EXPECT_LT(drawn(plotCellsOverWalls(cells, 0.05, plan, "hybrid-20")).size(), 150000u);
}

}  // namespace
}  // namespace hybrid_slam::comparison
