#include "study/simulation/MovableThings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <string>

#include "study/simulation/BuildingPlan.h"
#include "study/simulation/Route.h"
#include "study/simulation/Simulation.h"
#include "study/simulation/SimulationOutput.h"
#include "testing/ErrorOf.h"
#include "testing/TemporaryFile.h"

namespace hybrid_slam::simulation {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string kCsie = SOURCE_DIR "/datasets/csie/";

/// A room of 8 m x 6 m with a gap in its south wall and a column.
BuildingPlan roomWithAColumn() {
  return BuildingPlan::load(
      test::TemporaryFile("rectangle 0 0 8 6\ndoor 2 0 3 0\ncircle 6 4 0.5\nwall 1 5 1.1 5\n").path());
}

MovableThings thingsOf(const std::string& text) {
  return MovableThings::load(test::TemporaryFile(text).path(), roomWithAColumn());
}

std::string thingsError(const std::string& text) {
  return test::errorOf([&] { thingsOf(text); });
}

/// Names and first corners of the things of a session.
std::string textOf(const std::vector<PlacedThing>& things) {
  std::string text;
  for (const PlacedThing& thing : things)
    text += thing.name + " " + std::to_string(thing.walls.front().start.x) + " " +
            std::to_string(thing.walls.front().start.y) + "\n";
  return text;
}

TEST(MovableThings, ADoorIsAWallOrNothingAndABoxFourWallsAtOneOfItsPlaces) {
  const MovableThings things = thingsOf("door 2 0 3 0 # south\nbox 0.5 1  1 1  4 2  6 1\n");
  std::set<size_t> counts;
  std::map<double, int> boxesAt;
  for (uint64_t session = 1; session <= 300; ++session) {
    const std::vector<PlacedThing> placed = things.inSession(7, session);
    counts.insert(placed.size());
    const PlacedThing& box = placed.back();
    EXPECT_EQ(box.name, "box 1");
    ASSERT_EQ(box.walls.size(), 4u);
    for (size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(box.walls[i].end, box.walls[(i + 1) % 4].start);
      EXPECT_DOUBLE_EQ(box.walls[i].length(), i % 2 == 0 ? 0.5 : 1);
    }
    ++boxesAt[box.walls.front().start.x];
    if (placed.size() == 2) {
      EXPECT_EQ(placed.front().name, "door 1");
      EXPECT_EQ(placed.front().walls.front().end, mrpt::math::TPoint2D(3, 0));
    }
  }
  EXPECT_EQ(counts, (std::set<size_t>{1, 2}));
  ASSERT_EQ(boxesAt.size(), 3u);
  for (const auto& [x, times] : boxesAt) EXPECT_NEAR(times, 100, 35) << x;  // four sigma
  EXPECT_EQ(things.everywhere().size(), 1 + 3 * 4u);
}

TEST(MovableThings, ASessionIsReproducibleAndAnotherSessionOrSeedIsNot) {
  const BuildingPlan plan = BuildingPlan::load(kCsie + "csie.plan");
  const MovableThings things = MovableThings::load(kCsie + "csie.things", plan);
  std::set<std::string> sessions;
  for (uint64_t session = 1; session <= 10; ++session) {
    const std::string text = textOf(things.inSession(1, session));
    EXPECT_EQ(text, textOf(things.inSession(1, session)));
    sessions.insert(text);
    sessions.insert(textOf(things.inSession(2, session)));
  }
  EXPECT_EQ(sessions.size(), 20u);
}

TEST(MovableThings, AThingMoreDoesNotMoveTheOthers) {
  const std::string boxes = "box 0.5 1  1 1  4 2\nbox 1 1  6 1  2 3\n";
  const MovableThings fewer = thingsOf(boxes), more = thingsOf(boxes + "box 0.2 0.2  7 5  0.2 0.2\n");
  for (uint64_t session = 1; session <= 20; ++session)
    EXPECT_THAT(textOf(more.inSession(1, session)), testing::StartsWith(textOf(fewer.inSession(1, session))));
}

/// The room is also seen through the simulated laser, with noise.
TEST(MovableThings, TheNoiseOfTwoSessionsDiffersInTheSameWorld) {
  const Route route = Route::load(test::TemporaryFile("start 1 1 0\ngo 4 1\n").path());
  SimulationOptions first, second;
  second.session = 2;
  const SimulatedLog a = simulate(roomWithAColumn(), route, first, {}, {}),
                     b = simulate(roomWithAColumn(), route, first, {}, {}),
                     c = simulate(roomWithAColumn(), route, second, {}, {});
  EXPECT_EQ(a.odometryAtScans.back(), b.odometryAtScans.back());
  EXPECT_NE(a.odometryAtScans.back(), c.odometryAtScans.back());
  const auto& scan = *a.scans.front();
  size_t different = 0;
  for (size_t i = 0; i < scan.getScanSize(); ++i) {
    EXPECT_EQ(scan.getScanRange(i), b.scans.front()->getScanRange(i));
    different += scan.getScanRange(i) != c.scans.front()->getScanRange(i);
  }
  EXPECT_GT(different, scan.getScanSize() / 2);
}

TEST(MovableThings, TheFloorPlanOfASessionIsReadBack) {
  const BuildingPlan plan = BuildingPlan::load(kCsie + "csie.plan");
  const MovableThings things = MovableThings::load(kCsie + "csie.things", plan);
  const std::vector<PlacedThing> placed = things.inSession(1, 3);
  const BuildingPlan expected = plan.with(wallsOf(placed));
  const test::TemporaryFile file("");
  writeFloorPlan(plan, placed, file.path());
  const BuildingPlan read = BuildingPlan::load(file.path());
  ASSERT_EQ(read.walls().size(), expected.walls().size());
  for (size_t i = 0; i < read.walls().size(); ++i)
    for (const double fraction : {0.0, 0.3, 1.0})
      EXPECT_LT((read.walls()[i].pointAt(fraction) - expected.walls()[i].pointAt(fraction)).norm(), 1e-5);
}

TEST(MovableThings, ErrorsNameTheLineAndWhatWasExpected) {
  EXPECT_EQ(thingsError("# nothing\n"), "no error");
  EXPECT_THAT(thingsError("\nbux 1 1 1 1 2 2\n"),
              AllOf(HasSubstr("unknown word `bux`"), HasSubstr(", line 2; ")));
  EXPECT_THAT(thingsError("door 2 0 3\n"), HasSubstr("expected `door X1 Y1 X2 Y2`"));
  EXPECT_THAT(thingsError("door 2 0 2 0\n"), HasSubstr("door of zero length"));
  EXPECT_THAT(thingsError("door 4 0 5 0\n"), HasSubstr("door along a wall"));
  EXPECT_THAT(thingsError("box 1 1 1 1\n"), HasSubstr("at least two places"));
  EXPECT_THAT(thingsError("box 1 1 1 1 2\n"), HasSubstr("`box` with 5 numbers"));
  EXPECT_THAT(thingsError("box 1 0 1 1 2 2\n"), HasSubstr("box without area"));
  EXPECT_THAT(thingsError("box -1 1 1 1 2 2\n"), HasSubstr("box without area"));
  std::string many = "box 0.1 0.1";
  for (int i = 0; i < 1001; ++i) many += " 1 1";
  EXPECT_THAT(thingsError(many), HasSubstr("too many places"));
}

TEST(MovableThings, ABoxStandsOnNothingElse) {
  EXPECT_EQ(thingsError("box 1 1  2 2  2.5 2.5\n"), "no error") << "places of one box may overlap";
  EXPECT_THAT(thingsError("box 1 1  2 2  7.5 2\n"),
              AllOf(HasSubstr("box at (7.50, 2.00) stands on a wall or a door"), HasSubstr(", line 1; ")));
  EXPECT_THAT(thingsError("box 1 1  2 2  0 2\n"), HasSubstr("stands on a wall")) << "touches it";
  EXPECT_THAT(thingsError("box 2 2  5 3  1 1\n"), HasSubstr("stands on a wall")) << "the column is inside";
  EXPECT_THAT(thingsError("box 1 1  0.5 4.5  2 2\n"), HasSubstr("stands on a wall"))
      << "the short wall is inside";
  EXPECT_THAT(thingsError("box 0.2 0.2  5.9 3.9  2 2\n"), "no error") << "in the hollow column";
  EXPECT_THAT(thingsError("door 2 0 3 0\nbox 0.5 0.5  2.2 -0.2  2 2\n"),
              HasSubstr("stands on a wall or a door"));
  EXPECT_THAT(thingsError("box 1 1  2 2  4 2\nbox 1 1  1 1.5  3 4\n"),
              HasSubstr("box at (2.00, 2.00) stands on a place of another box"));
}

}  // namespace
}  // namespace hybrid_slam::simulation
