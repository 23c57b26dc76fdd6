#include "run/RobotParts.h"

#include <gtest/gtest.h>

#include "testing/TestLogs.h"

namespace hybrid_slam::run {
namespace {

using mrpt::math::TPose2D;

constexpr size_t kLap = 80;  // steps

/// The reading of a step, with some ranges (m) at the robot itself.
readings::Reading step(size_t i, const TPose2D& from, const TPose2D& to, const std::vector<float>& parts) {
  const double time = 0.2 * static_cast<double>(i);
  const auto scan = test::scan(time, to);
  for (size_t k = 0; k < parts.size(); ++k) scan->setScanRange(30 + k, parts[k]);
  readings::Reading reading;
  reading.scans = {scan};
  reading.timestamp = time;
  reading.motion = to - from;
  return reading;
}

/// The longest range at the robot after two laps in a room.
double farthestOf(const std::vector<float>& parts) {
  RobotParts found;
  for (size_t i = 1; i < 2 * kLap; ++i)
    found.add(step(i, test::poseOnLap(i - 1, kLap), test::poseOnLap(i, kLap), parts));
  return found.farthest();
}

TEST(RobotParts, EndBeamsWhereverTheRobotGoes) {
  EXPECT_EQ(farthestOf({}), 0) << "walls";
  EXPECT_NEAR(farthestOf({0.2F, 0.21F, 0.25F, 0.2F}), 0.25, 1e-6);
  EXPECT_EQ(farthestOf({0.2F, 0.2F}), 0) << "two beams";
  EXPECT_EQ(farthestOf({0.5F, 0.5F, 0.5F}), 0) << "a narrow corridor has such walls";
}

TEST(RobotParts, ARobotThatStandsOrDrivesAlongAWallSeesTheSame) {
  const std::vector<float> wall(20, 0.3F);
  RobotParts standing, straight;
  for (size_t i = 1; i < 500; ++i) {
    standing.add(step(i, {}, {}, wall));
    straight.add(
        step(i, {0.05 * static_cast<double>(i - 1), 0, 0}, {0.05 * static_cast<double>(i), 0, 0}, wall));
  }
  EXPECT_EQ(standing.farthest(), 0);
  EXPECT_EQ(straight.farthest(), 0);
}

TEST(RobotParts, BeamsThatOftenSeeFartherAreNotAtTheRobot) {
  RobotParts found;
  for (size_t i = 1; i < 2 * kLap; ++i)
    found.add(step(i, test::poseOnLap(i - 1, kLap), test::poseOnLap(i, kLap),
                   std::vector<float>(5, i % 20 == 0 ? 0.35F : 0.2F)));
  EXPECT_EQ(found.farthest(), 0);
}

}  // namespace
}  // namespace hybrid_slam::run
