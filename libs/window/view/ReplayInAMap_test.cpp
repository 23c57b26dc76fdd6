// A replay in the map of an earlier run.
#include <gmock/gmock.h>

#include "run/Replay.h"
#include "testing/DriveLog.h"
#include "testing/ReplaySessionTest.h"

namespace hybrid_slam::window {
namespace {

using Method = run::RunOptions::Method;
using State = ReplaySnapshot::State;
using testing::HasSubstr;

/// The map of an earlier run, and a log of the same room.
class ReplayInAMap : public test::ReplaySessionTest {
 protected:
  ReplayInAMap() {
    earlier.run.output = folder.path("earlier");
    const std::atomic<bool> stop{false};
    run::replay(earlier, true, stop);
  }
  const std::string session = folder.path("earlier/session.hslam");
  run::Configuration earlier = configuration(drive(1)), now = configuration(drive(2));

 private:
  std::string drive(uint64_t seed) {
    return test::writeGzipped(folder.path("drive" + std::to_string(seed) + ".rawlog"),
                              test::logOf(test::drive(8, seed)));
  }
};

TEST_F(ReplayInAMap, ShowsTheSearchForTheStartAndThenTheRobot) {
  now.run.localizeIn = session;
  ReplaySession replay(now, {Method::hybrid});
  replay.seek(1);
  ASSERT_TRUE(reaches(replay, State::paused, 1));
  ASSERT_TRUE(test::happens([&] { return replay.snapshot()->filters.at(0) != nullptr; }));
  const auto searching = replay.snapshot()->filters[0];
  ASSERT_TRUE(searching->place);
  EXPECT_FALSE(searching->place->isKnown);
  EXPECT_THAT(describe(*searching->place), testing::MatchesRegex("start unknown: [0-9]+ hypotheses"));
  EXPECT_GT(searching->particles.size(), 20u) << "places all over the map";
  EXPECT_FALSE(searching->lines.empty());
  EXPECT_TRUE(searching->path.empty());
  EXPECT_TRUE(searching->plot.empty());
  EXPECT_GT(searching->map.width, 100) << "the map is known";

  replay.setSpeed(0);
  replay.play();
  ASSERT_TRUE(test::happens([&] { return replay.snapshot()->state == State::ended; }));
  const auto found = replay.snapshot()->filters[0];
  ASSERT_TRUE(found->place);
  EXPECT_EQ(describe(*found->place), "localised");
  EXPECT_EQ(found->map.grey, searching->map.grey) << "unchanged";
  ASSERT_FALSE(found->path.empty());
  EXPECT_LT(found->path.size(), found->updates) << "since the place has been known";
  EXPECT_EQ(found->plot.size(), found->path.size());
  for (size_t i = 1; i < found->path.size(); ++i)
    EXPECT_LT((found->path[i] - found->path[i - 1]).norm(), 0.5) << "no jumps";
}

TEST_F(ReplayInAMap, MapsOnWhereThePlaceIsFound) {
  now.run.continueFrom = session;
  ReplaySession replay(now, {Method::hybrid});
  replay.seek(1);
  ASSERT_TRUE(reaches(replay, State::paused, 1));
  ASSERT_TRUE(test::happens([&] { return replay.snapshot()->filters.at(0) != nullptr; }));
  EXPECT_TRUE(replay.snapshot()->filters[0]->place);
  replay.saveMap(folder.path("saved"));
  ASSERT_TRUE(test::happens([&] { return replay.snapshot()->messages == 1; }));
  EXPECT_THAT(replay.snapshot()->message, HasSubstr("place not found"));
  replay.setSpeed(0);
  replay.play();
  ASSERT_TRUE(test::happens([&] { return replay.snapshot()->state == State::ended; }));
  EXPECT_FALSE(replay.snapshot()->filters[0]->place) << "it maps";
  EXPECT_THAT(replay.snapshot()->note, HasSubstr("hybrid: place found after"));
}

TEST_F(ReplayInAMap, AFloorPlanIsForTheFilterWithLines) {
  std::string corners;
  const auto add = [&](const mrpt::math::TPoint2D& at) {
    corners += (corners.empty() ? "[" : ",[") + std::to_string(at.x) + "," + std::to_string(at.y) + "]";
  };
  for (const auto& wall : test::room()) add(wall.first);
  add(test::room().front().first);
  now.run.priorPlan = folder.write(
      "room.geojson", R"({"features":[{"geometry":{"type":"LineString","coordinates":[)" + corners + "]}}]}");
  now.run.start = mrpt::math::TPose2D(0, 0, 0);
  ReplaySession replay(now, {Method::hybrid, Method::general});
  replay.setSpeed(0);
  replay.play();
  ASSERT_TRUE(test::happens([&] { return replay.snapshot()->state == State::ended; }));
  EXPECT_EQ(replay.snapshot()->messages, 0u) << replay.snapshot()->message;
  EXPECT_THAT(replay.snapshot()->events,
              testing::Contains(testing::AllOf(HasSubstr("hybrid: place found"), HasSubstr("room.geojson"))));
}

TEST_F(ReplayInAMap, AFileThatIsNoMapFailsWithItsName) {
  now.run.localizeIn = folder.write("none.hslam", "none");
  ReplaySession replay(now, {Method::hybrid});
  ASSERT_TRUE(test::happens([&] { return replay.snapshot()->state == State::failed; }));
  EXPECT_THAT(replay.snapshot()->message, HasSubstr("none.hslam"));
}

}  // namespace
}  // namespace hybrid_slam::window
