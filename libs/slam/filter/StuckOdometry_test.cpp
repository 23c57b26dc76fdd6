#include "slam/filter/StuckOdometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "base/RandomStream.h"
#include "testing/RoomLog.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr size_t kSteps = 80;  // of a lap, 5 per second
TPose2D truth(size_t step) { return test::poseOnLap(step, kSteps); }
TPose2D moved(size_t step) { return step == 0 ? TPose2D() : truth(step) - truth(step - 1); }
double timeOf(size_t step) { return 0.2 * static_cast<double>(step); }

/// The motions of a lap with this odometry, step by step.
struct StuckLap {
  explicit StuckLap(const std::function<TPose2D(size_t)>& odometry, StuckOdometry stuck = make()) {
    for (size_t i = 0; i < kSteps; ++i) {
      motions.push_back(stuck.motionTo(odometry(i), {test::scan(timeOf(i), truth(i))}, timeOf(i)));
      stuckScans += stuck.isStuck();
    }
  }
  static StuckOdometry make() { return {GridOptions(), ScanMatcherOptions()}; }
  void expectTrue(size_t from) const {
    TPose2D pose;
    for (size_t i = 0; i < kSteps; ++i) {
      pose = pose + motions[i];
      if (i < from) continue;
      const TPose2D error = pose - (truth(i) - truth(0));
      EXPECT_LT(error.norm(), 0.06) << i;
      EXPECT_LT(std::abs(error.phi), 0.02) << i;
    }
  }
  std::vector<TPose2D> motions;
  size_t stuckScans = 0;
};

/// The odometry stands still in steps 20 to 49.
bool isStuckAt(size_t step) { return 20 <= step && step < 50; }

TEST(StuckOdometry, GoodOdometryIsReturnedUnchanged) {
  const StuckLap lap(moved);
  for (size_t i = 0; i < kSteps; ++i) EXPECT_EQ(lap.motions[i], moved(i));
  EXPECT_EQ(lap.stuckScans, 0u);
}

TEST(StuckOdometry, TheScansGiveTheMotionUntilTheOdometryAgrees) {
  const StuckLap lap([](size_t i) { return isStuckAt(i) ? TPose2D() : moved(i); });
  lap.expectTrue(24);
  for (size_t i = 0; i < 20; ++i) EXPECT_EQ(lap.motions[i], moved(i));
  for (size_t i = 51; i < kSteps; ++i) EXPECT_EQ(lap.motions[i], moved(i)) << "trusted again";
  EXPECT_GE(lap.stuckScans, 26u);
}

// The connection is restored, and the odometry has counted on.
TEST(StuckOdometry, TheMissedMotionIsNotCountedTwice) {
  StuckLap([](size_t i) {
    return isStuckAt(i) ? TPose2D() : i == 50 ? truth(50) - truth(19) : moved(i);
  }).expectTrue(24);
}

/// A robot that goes on, or stops, where the odometry stands still, with a scan per 0.8 m.
TEST(StuckOdometry, WithFewScansTheRobotIsExpectedToDriveOn) {
  for (const bool isStopped : {false, true}) {
    SCOPED_TRACE(isStopped);
    StuckOdometry stuck = StuckLap::make();
    const auto at = [isStopped](size_t i) {
      return test::poseOnLap(isStopped ? std::min<size_t>(i, 3) : i, 12);
    };
    TPose2D pose;
    for (size_t i = 0; i < 9; ++i) {
      const bool stands = i == 0 || i > 3;
      pose = pose + stuck.motionTo(stands ? TPose2D() : at(i) - at(i - 1), {test::scan(1, at(i))},
                                   2.0 * static_cast<double>(i));
      const TPose2D error = pose - (at(i) - at(0));
      EXPECT_LT(error.norm(), 0.06) << i;
      EXPECT_LT(std::abs(error.phi), 0.03) << i;
    }
    EXPECT_EQ(stuck.isStuck(), !isStopped);
  }
}

TEST(StuckOdometry, OdometryThatIsStuckForEverIsReplacedForEver) {
  StuckLap([](size_t) { return TPose2D(); }).expectTrue(4);
}

TEST(StuckOdometry, OdometryThatNeverAgreesIsUsedAgainAtLast) {
  const auto wrong = [](size_t i) { return TPose2D(-moved(i).x, 0, -moved(i).phi); };
  const StuckLap lap([&](size_t i) { return isStuckAt(i) ? TPose2D() : wrong(i); });
  EXPECT_NE(lap.motions[60], wrong(60));
  for (size_t i = 70; i < kSteps; ++i) EXPECT_EQ(lap.motions[i], wrong(i));
}

/// Distance (m) to a person (a cylinder of 0.5 m) along a beam; infinite if the beam passes by.
double rangeTo(const TPoint2D& person, const TPose2D& robot, double angle) {
  constexpr double kRadius = 0.25;
  const double x = person.x - robot.x, y = person.y - robot.y, heading = robot.phi + angle;
  const double along = x * std::cos(heading) + y * std::sin(heading);
  const double across = x * std::sin(heading) - y * std::cos(heading);
  if (along < 0 || std::abs(across) > kRadius) return std::numeric_limits<double>::infinity();
  return std::max(0.05, along - std::sqrt(kRadius * kRadius - across * across));
}

/// Range noise of 2 cm, and four people who walk through the room at 1 m/s past the robot, for a minute.
TEST(StuckOdometry, ARobotThatStandsAmongPeopleIsLeftAlone) {
  for (uint64_t run = 0; run < 20; ++run) {
    StuckOdometry stuck = StuckLap::make();
    RandomStream random(5, run, 0);
    const TPose2D robot = truth(static_cast<size_t>(4 * run));
    std::array<TPose2D, 4> people;
    for (size_t i = 0; i < 300; ++i) {
      for (TPose2D& person : people) {
        const bool isTooNear = std::hypot(person.x - robot.x, person.y - robot.y) < 0.6;
        if (isTooNear || random.uniform() < 0.03)
          person = {8 * random.uniform() - 4, 4 * random.uniform() - 2, 2 * M_PI * random.uniform()};
        person = person + TPose2D(0.2, 0, 0);
      }
      const auto scan = test::scan(timeOf(i), robot);
      for (size_t k = 0; k < 181; ++k) {
        double range = scan->getScanRange(k);
        for (const TPose2D& person : people)
          range = std::min(range,
                           rangeTo({person.x, person.y}, robot, (static_cast<double>(k) - 90) * M_PI / 180));
        scan->setScanRange(k, static_cast<float>(range + 0.02 * random.gaussian()));
      }
      EXPECT_EQ(stuck.motionTo({}, {scan}, timeOf(i)), TPose2D());
    }
    EXPECT_FALSE(stuck.isStuck()) << run;
  }
}

TEST(StuckOdometry, ASessionGoesOnFromAnyStep) {
  const auto odometry = [](size_t i) { return isStuckAt(i) ? TPose2D() : moved(i); };
  const StuckLap whole(odometry);
  for (const size_t cut : {1u, 21u, 22u, 35u, 50u, 51u}) {
    StuckOdometry first = StuckLap::make(), second = StuckLap::make();
    for (size_t i = 0; i < cut; ++i)
      first.motionTo(odometry(i), {test::scan(timeOf(i), truth(i))}, timeOf(i));
    std::string bytes;
    StateWriter out(bytes);
    out(first);
    StateReader in(bytes);
    in(second);
    EXPECT_TRUE(in.isAtEnd());
    for (size_t i = cut; i < kSteps; ++i)
      EXPECT_EQ(second.motionTo(odometry(i), {test::scan(timeOf(i), truth(i))}, timeOf(i)), whole.motions[i]);
  }
}

}  // namespace
}  // namespace hybrid_slam
