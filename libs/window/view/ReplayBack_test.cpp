/// A replay that goes back: from a checkpoint, or from the beginning.
#include <gtest/gtest.h>

#include <string>

#include "testing/ReplaySessionTest.h"
#include "testing/TestLogs.h"
#include "window/view/Checkpoints.h"

namespace hybrid_slam::window {
namespace {

using Method = run::RunOptions::Method;
using State = ReplaySnapshot::State;
using ReplayBack = test::ReplaySessionTest;

TEST_F(ReplayBack, GoesBackFromACheckpointToTheSameBytes) {
  const run::Configuration c = laps();
  ReplaySession straight(c, {Method::hybrid, Method::general}), back(c, {Method::hybrid, Method::general});
  straight.seek(33);
  ASSERT_TRUE(reaches(straight, State::paused, 33));
  back.seek(kScans);
  ASSERT_TRUE(reaches(back, State::ended, kScans));
  back.seek(34);
  ASSERT_TRUE(reaches(back, State::paused, 34));
  back.stepBack();
  ASSERT_TRUE(reaches(back, State::paused, 33));
  EXPECT_EQ(back.snapshot()->run, 1u) << "not from the beginning";
  const auto shown = [](const ReplaySession& session, size_t i) { return session.snapshot()->filters.at(i); };
  for (const size_t i : {0u, 1u}) {
    ASSERT_TRUE(test::happens([&] { return shown(straight, i) && shown(back, i); }));
    const auto one = shown(straight, i), other = shown(back, i);
    EXPECT_EQ(one->map.grey, other->map.grey);
    EXPECT_EQ(one->plot.size(), other->plot.size());
    EXPECT_EQ(one->scanLines.size(), other->scanLines.size());
    EXPECT_EQ(one->step.ess, other->step.ess);
    ASSERT_TRUE(one->verdict && other->verdict);
    EXPECT_EQ(one->verdict->line(), other->verdict->line());
  }
  for (auto* session : {&straight, &back}) {
    session->setSpeed(0);
    session->play();
    ASSERT_TRUE(reaches(*session, State::ended, kScans));
    session->exportResults(folder.path(session == &back ? "back" : "straight"));
    ASSERT_TRUE(test::happens([&] { return session->snapshot()->messages == 1; }));
    EXPECT_FALSE(session->snapshot()->isError) << session->snapshot()->message;
  }
  for (const std::string method : {"/hybrid", "/general"})
    for (const char* name :
         {"/trajectory.tum", "/map.pgm", "/lines.csv", "/covariance.csv", "/map.simplemap.gz"})
      EXPECT_EQ(test::contentOf(folder.path("back") + method + name),
                test::contentOf(folder.path("straight") + method + name))
          << method << name;
}

TEST_F(ReplayBack, GoesBackFromTheBeginningBesideAMethodWithoutCheckpoints) {
  ReplaySession session(laps(), {Method::hybrid, Method::ortho});
  session.seek(40);
  ASSERT_TRUE(reaches(session, State::paused, 40));
  EXPECT_EQ(session.snapshot()->run, 1u);
  session.stepBack();
  ASSERT_TRUE(reaches(session, State::paused, 39));
  EXPECT_EQ(session.snapshot()->run, 2u);
}

TEST(Checkpoints, AreFartherApartWhenTheirMemoryIsUsedUp) {
  const FilterWatch watch{run::Configuration()};
  Checkpoints all(1000);
  for (size_t scan = 0; scan <= 1000; ++scan)
    if (all.isDue(scan)) all.add(scan, {0, double(scan), {{std::string(100, 'x'), watch}}});
  EXPECT_LE(all.size(), 10u);
  EXPECT_GE(all.size(), 5u);
  EXPECT_EQ(all.upTo(10), nullptr);
  for (size_t scan = all.every(); scan <= 1000; ++scan) {
    ASSERT_NE(all.upTo(scan), nullptr);
    EXPECT_EQ(all.upTo(scan)->first, scan / all.every() * all.every());
  }
}

}  // namespace
}  // namespace hybrid_slam::window
