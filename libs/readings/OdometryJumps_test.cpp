#include "readings/OdometryJumps.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hybrid_slam::readings {
namespace {

using mrpt::math::TPose2D;

/// A robot that drives 3 s along x at 10 Hz.
class Drive {
 public:
  explicit Drive(double speed) {
    for (int i = 0; i < 30; ++i) jumps_ += move(0.1 * speed);
  }
  bool move(double dx, double dy = 0, double seconds = 0.1) {
    at_.x += dx, at_.y += dy, time_ += seconds;
    return odometry_.isJump(at_, time_);
  }
  bool moveWithoutTime(double dx) {
    at_.x += dx;
    return odometry_.isJump(at_, std::nullopt);
  }
  int jumps() const { return jumps_; }

 private:
  OdometryJumps odometry_;
  TPose2D at_;
  double time_ = 0;
  int jumps_ = 0;
};

TEST(OdometryJumps, ARobotThatDrivesDoesNotJump) {
  for (const double speed : {0.0, 0.3, 2.0}) {
    Drive drive(speed);
    EXPECT_EQ(drive.jumps(), 0) << speed;
    EXPECT_FALSE(drive.move(0.1)) << "starts to move, or brakes";
    EXPECT_FALSE(drive.move(4, 0, 5)) << "readings are missing";
  }
}

TEST(OdometryJumps, AStepFasterThanTheRobotIsAJump) {
  Drive slow(0.5);
  EXPECT_TRUE(slow.move(0, -0.7));
  EXPECT_FALSE(slow.move(0.05)) << "the odometry continues from there";
  EXPECT_FALSE(slow.move(0.45)) << "short";
  Drive fast(3);
  EXPECT_FALSE(fast.move(1.4));
  EXPECT_TRUE(fast.move(50, 50));
}

TEST(OdometryJumps, AnOutlierJumpsThereAndBack) {
  Drive drive(0.5);
  EXPECT_TRUE(drive.move(3, 4));
  EXPECT_TRUE(drive.move(-3, -4));
  EXPECT_FALSE(drive.move(0.05));
}

TEST(OdometryJumps, PossibleReadings) {
  EXPECT_TRUE(isPossible({5e6, 4e5, 0})) << "map coordinates";
  EXPECT_TRUE(isPossible({0, 0, 4000})) << "not wrapped";
  for (const double wrong : {1e30, -1e300, double(INFINITY), double(NAN)}) {
    EXPECT_FALSE(isPossible({wrong, 0, 0})) << wrong;
    EXPECT_FALSE(isPossible({0, wrong, 0})) << wrong;
    EXPECT_FALSE(isPossible({0, 0, wrong})) << wrong;
    EXPECT_TRUE(isJump({}, {0, 0, wrong})) << wrong;
  }
}

/// A log that begins on a fast vehicle loses one step.
TEST(OdometryJumps, ASecondFastStepIsAMotion) {
  Drive drive(25);
  EXPECT_EQ(drive.jumps(), 1);
  EXPECT_FALSE(drive.move(2.6));
}

/// Readings are late, and arrive with nearly equal times.
TEST(OdometryJumps, BurstsOfReadingsAreNoSpeed) {
  Drive drive(0.5);
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(drive.move(0.4, 0, i % 4 == 0 ? 3.2 : 0.001));
  EXPECT_FALSE(drive.move(0.4, 0, 0)) << "the same time again";
  EXPECT_TRUE(drive.move(0, 8, 1.5));
}

TEST(OdometryJumps, WithoutTimeASecondIsAssumed) {
  for (const double seconds : {double(NAN), 0.0, -1.0}) {
    Drive drive(0.5);
    const auto move = [&](double dx) {
      return std::isnan(seconds) ? drive.moveWithoutTime(dx) : drive.move(dx, 0, seconds);
    };
    EXPECT_FALSE(move(4));
    EXPECT_TRUE(move(25)) << seconds;
    EXPECT_FALSE(move(1));
  }
}

TEST(OdometryJumps, ALargeDistanceIsImpossible) {
  Drive drive(0.5);
  EXPECT_TRUE(drive.move(0, 101, 1000));
}

}  // namespace
}  // namespace hybrid_slam::readings
