#include "study/comparison/PlanView.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/comparison/XmlCheck.h"

namespace hybrid_slam::comparison {
namespace {

using mrpt::math::TPoint2D;
using testing::HasSubstr;

size_t count(const std::string& text, const std::string& part) {
  size_t n = 0;
  for (size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++n;
  return n;
}

TEST(PlanView, MetresToPixelsUpwards) {
  const PlanView view({-2, 12}, {10, 20}, 5);
  EXPECT_DOUBLE_EQ(view.pixel({-2, 12}).x, 10);
  EXPECT_DOUBLE_EQ(view.pixel({-2, 12}).y, 20);
  EXPECT_DOUBLE_EQ(view.pixel({0, 10}).x, 20);
  EXPECT_DOUBLE_EQ(view.pixel({0, 10}).y, 30);
}

TEST(PlanView, TheScaleBarIsTheLongestRoundOneThatFits) {
  for (const auto& [scale, text] : {std::pair<double, const char*>{10, ">10 m<"},
                                    {11, ">5 m<"},
                                    {49, ">2 m<"},
                                    {200, ">0.5 m<"},
                                    {0.5, ">200 m<"}}) {
    Svg svg(100, 100);
    PlanView({0, 0}, {0, 0}, scale).drawScaleBar(svg, {0, 50}, 100);
    EXPECT_THAT(svg.str(""), HasSubstr(text)) << scale;
  }
}

TEST(CellsOverWalls, AreColouredByTheirDistance) {
  const simulation::FloorPlan plan(
      {simulation::Wall::straight({0, 0}, {10, 0}), simulation::Wall::straight({0, 10}, {10, 10})});
  // On a wall twice, 0.2 m off, 1 m off, and far outside of the plan.
  const std::string svg =
      plotCellsOverWalls({{1, 0}, {2, 0.05}, {3, 0.2}, {4, 1}, {5, 99}}, 0.05, plan, "hybrid-20: a < b");
  EXPECT_EQ(xmlDefect(svg), "");
  EXPECT_THAT(svg, HasSubstr("hybrid-20: a &lt; b"));
  EXPECT_EQ(count(svg, "<polyline"), 2u);
  const auto squares = [&](const std::string& colour) {  // but for the key's
    const auto end = svg.find("\" style=\"fill:" + colour);
    const auto begin = svg.rfind("<path d=\"", end);
    return end == std::string::npos ? 0 : count(svg.substr(begin, end - begin), "z");
  };
  EXPECT_EQ(squares("#000"), 2u);
  EXPECT_EQ(squares("#e69f00"), 1u);
  EXPECT_EQ(squares("#d55e00"), 1u);
}

}  // namespace
}  // namespace hybrid_slam::comparison
