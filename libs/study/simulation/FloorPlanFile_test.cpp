#include "study/simulation/FloorPlanFile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>

#include <cmath>

#include "base/Errors.h"
#include "study/simulation/BuildingPlan.h"
#include "testing/CommaLocale.h"
#include "testing/ErrorOf.h"
#include "testing/TemporaryFile.h"

namespace hybrid_slam::simulation {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::vector<Wall> wallsOf(const std::string& text) { return readWalls(test::TemporaryFile(text).path()); }

std::string errorOf(const std::string& text) {
  return test::errorOf([&] { wallsOf(text); });
}

double totalLength(const std::vector<Wall>& walls) {
  double length = 0;
  for (const Wall& wall : walls) length += wall.length();
  return length;
}

TEST(FloorPlanFile, IsTheSameInEveryLocale) {
  const test::CommaLocale german;
  EXPECT_NEAR(totalLength(wallsOf("polyline 0 0.5 1.25 0.5")), 1.25, 1e-12);
}

TEST(FloorPlanFile, EveryWordMakesItsWalls) {
  EXPECT_EQ(wallsOf("wall 0 0 3 4").size(), 1u);
  EXPECT_NEAR(totalLength(wallsOf("wall 0 0 3 4")), 5, 1e-12);
  EXPECT_NEAR(totalLength(wallsOf("polyline 0 0 1 0 1 2 -1 2")), 5, 1e-12);
  EXPECT_NEAR(totalLength(wallsOf("polygon 0 0 3 0 3 4 0 0")), 12, 1e-12);
  EXPECT_NEAR(totalLength(wallsOf("rectangle 0 0 2 3")), 10, 1e-12);
  EXPECT_NEAR(totalLength(wallsOf("circle 5 5 2")), 4 * M_PI, 1e-12);
  EXPECT_NEAR(totalLength(wallsOf("arc 5 5 2 0 90")), M_PI, 1e-12);
  EXPECT_NEAR(totalLength(wallsOf("arc 5 5 2 350 10")), 2 * mrpt::DEG2RAD(20.0), 1e-12);
}

TEST(FloorPlanFile, CommentsAndEmptyLinesAreSkipped) {
  EXPECT_EQ(wallsOf("# a room\n\n  wall 0 0 1 0 # south\n\t\nwall 0 0 0 1\r\n").size(), 2u);
}

TEST(FloorPlanFile, ADoorIsAGapAnywhereInTheFile) {
  for (const char* text : {"wall 0 0 10 0\ndoor 4 0 5 0\n", "door 5 0 4 0\nwall 10 0 0 0\n"}) {
    const BuildingPlan plan(wallsOf(text));
    EXPECT_EQ(plan.walls().size(), 2u);
    for (double x = 0.05; x < 10; x += 0.1)
      EXPECT_EQ(plan.castRay({x, -1}, M_PI / 2, 5).has_value(), x < 4 || x > 5) << x;
  }
  // At the end of a wall, across two walls in line, and in a slanted one.
  EXPECT_NEAR(totalLength(wallsOf("wall 0 0 10 0\ndoor 0 0 1 0")), 9, 1e-9);
  EXPECT_NEAR(totalLength(wallsOf("polyline 0 0 2 0 4 0\ndoor 1 0 3 0")), 2, 1e-9);
  EXPECT_NEAR(totalLength(wallsOf("wall 0 0 3 4\ndoor 0.6 0.8 1.2 1.6")), 4, 1e-9);
}

TEST(FloorPlanFile, ADoorWithDepthOpensBothFacesAndHasJambs) {
  const BuildingPlan plan(wallsOf("wall 0 0 10 0\nwall 0 0.2 10 0.2\ndoor 4 0 5 0 0.2\n"));
  EXPECT_NEAR(totalLength(plan.walls()), 9 + 9 + 0.2 + 0.2, 1e-9);
  EXPECT_FALSE(plan.castRay({4.5, -1}, M_PI / 2, 5));
  EXPECT_NEAR(plan.castRay({4.5, 0.1}, 0, 5).value(), 0.5, 1e-9);
}

TEST(FloorPlanFile, ARecessStandsBackFromTheWallOnTheLeft) {
  const BuildingPlan plan(wallsOf("wall 0 0 10 0\nrecess 4 0 5 0 0.3\n"));
  EXPECT_NEAR(plan.castRay({4.5, -1}, M_PI / 2, 5).value(), 1.3, 1e-9);
  EXPECT_NEAR(plan.castRay({3.5, -1}, M_PI / 2, 5).value(), 1.0, 1e-9);
  EXPECT_NEAR(plan.castRay({4.5, 0.2}, M_PI, 5).value(), 0.5, 1e-9);
  // The other way round, to the other side.
  const BuildingPlan niche(wallsOf("wall 0 0 10 0\nrecess 5 0 4 0 0.3\n"));
  EXPECT_NEAR(niche.castRay({4.5, -1}, M_PI / 2, 5).value(), 0.7, 1e-9);
}

TEST(FloorPlanFile, ErrorsNameTheLineAndWhatWasExpected) {
  EXPECT_THAT(errorOf("\nwal 0 0 1 0\n"), AllOf(HasSubstr("unknown word `wal`"), HasSubstr(", line 2; "),
                                                HasSubstr("nearest known word is `wall`")));
  EXPECT_THAT(errorOf("wall 0 0 1\n"), HasSubstr("expected `wall X1 Y1 X2 Y2`"));
  EXPECT_THAT(errorOf("wall 0 0 1 0x\n"), HasSubstr("`0x` is not a number"));
  EXPECT_THAT(errorOf("wall 0 0 1 nan\n"), HasSubstr("`nan` is not a number"));
  EXPECT_THAT(errorOf("wall 1 2 1 2\n"), AllOf(HasSubstr("zero length"), HasSubstr(", line 1; ")));
  EXPECT_THAT(errorOf("polyline 0 0 1 0 1 0 2 0\n"), HasSubstr("point 3 repeats the previous one"));
  std::string many = "polyline";
  for (int i = 0; i < 60'000; ++i) many += " " + std::to_string(i) + " 0";
  EXPECT_THAT(errorOf(many + "\n"), HasSubstr("too many numbers"));
  EXPECT_THAT(errorOf("polyline 0 0 1\n"), HasSubstr("`polyline` with 3 numbers"));
  EXPECT_THAT(errorOf("wall 0 0 1 1\npolygon 0 0 3 0 3 4 0 1\n"),
              AllOf(HasSubstr("polygon is not closed"), HasSubstr(", line 2; ")));
  EXPECT_THAT(errorOf("rectangle 0 0 0 3\n"), HasSubstr("zero length"));
  EXPECT_THAT(errorOf("arc 0 0 0 0 90\n"), HasSubstr("zero length"));
  EXPECT_THAT(errorOf("arc 0 0 1 90 90\n"), HasSubstr("zero length"));
  EXPECT_THAT(errorOf("arc 0 0 1 0 400\n"), HasSubstr("up to 360 deg"));
  EXPECT_THAT(errorOf("circle 0 0 -1\n"), HasSubstr("radius above 0"));
  EXPECT_THAT(errorOf("wall 0 0 10 0\ndoor 4 1 5 1\n"),
              AllOf(HasSubstr("`door` is on no wall"), HasSubstr(", line 2; ")));
  EXPECT_THAT(errorOf("wall 0 0 10 0\ndoor 9.5 0 10.5 0\n"), HasSubstr("on no wall"));
  EXPECT_THAT(errorOf("wall 0 0 10 0\nwall 0 0 10 0\ndoor 9.5 0 10.5 0\n"), HasSubstr("on no wall"));
  EXPECT_THAT(errorOf("wall 0 0 5 0\nwall 4 0 5 0\nwall 5.5 0 9 0\ndoor 4.5 0 6 0\n"),
              HasSubstr("on no wall"));
  EXPECT_EQ(errorOf("wall 5 0 9 0\nwall 5 0 1 0\nwall 0 1 9 1\ndoor 4 0 6 0\n"), "no error");
  EXPECT_THAT(errorOf("wall 0 0 10 0\ndoor 4 0 5 0 0.2\n"), HasSubstr("on no wall"));
  EXPECT_THAT(errorOf("wall 0 0 10 0\nrecess 4 0 4 0 0.2\n"), HasSubstr("on no wall"));
  EXPECT_THAT(errorOf("wall 0 0 10 0\nrecess 4 0 5 0 0\n"), HasSubstr("DEPTH"));
  EXPECT_THAT(errorOf("# nothing\n"), HasSubstr("floor plan without walls"));
}

TEST(FloorPlanFile, MissingFileAndFolderAreErrors) {
  EXPECT_THROW(BuildingPlan::load("/nowhere/at.all"), InputError);
  EXPECT_THROW(BuildingPlan::load("/"), InputError);
}

}  // namespace
}  // namespace hybrid_slam::simulation
