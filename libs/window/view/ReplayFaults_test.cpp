/// The results that the window writes, on a disk that is full.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "testing/FullDisk.h"
#include "testing/ReplaySessionTest.h"

namespace hybrid_slam::window {
namespace {

using Method = run::RunOptions::Method;
using State = ReplaySnapshot::State;
using ReplaySessionTest = test::ReplaySessionTest;

TEST_F(ReplaySessionTest, AFullDiskLeavesNoPartOfTheResults) {
  ReplaySession session(laps(), {Method::hybrid});
  session.setSpeed(0);
  session.play();
  ASSERT_TRUE(reaches(session, State::ended, kScans));
  std::mt19937 random(1);
  size_t messages = 0;
  for (int i = 0; i < 20; ++i) {
    {
      const test::FullDisk disk(std::uniform_int_distribution<rlim_t>(0, 5000)(random));
      session.exportResults(folder.path("out"));
      ASSERT_TRUE(test::happens([&] { return session.snapshot()->messages == messages + 1; }));
    }
    ++messages;
    EXPECT_TRUE(session.snapshot()->isError) << session.snapshot()->message;
    EXPECT_THAT(session.snapshot()->message, testing::HasSubstr("cannot write"));
    EXPECT_FALSE(std::filesystem::exists(folder.path("out/hybrid"))) << session.snapshot()->message;
  }
  session.exportResults(folder.path("out"));
  ASSERT_TRUE(test::happens([&] { return session.snapshot()->messages == messages + 1; }));
  EXPECT_FALSE(session.snapshot()->isError) << session.snapshot()->message;
  for (const char* name : {"trajectory.tum", "map.png", "map.pgm", "session.hslam", "metrics.json"})
    EXPECT_FALSE(test::contentOf(folder.path(std::string("out/hybrid/") + name)).empty()) << name;
}

}  // namespace
}  // namespace hybrid_slam::window
