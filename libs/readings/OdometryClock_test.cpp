#include "readings/OdometryClock.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "readings/Timestamps.h"
#include "testing/RoomLog.h"

namespace hybrid_slam::readings {
namespace {

using mrpt::obs::CObservation;
using testing::ElementsAre;
using testing::IsEmpty;

/// Times (s) of the observations that continue: of scans, and of odometry readings as negative numbers.
class OdometryClockTest : public testing::Test {
 protected:
  std::vector<double> scan(double time) { return times(clock.take(test::scan(time))); }
  std::vector<double> odometry(double time) { return times(clock.take(test::odometry(time, {}))); }
  static std::vector<double> times(const std::vector<CObservation::Ptr>& observations) {
    std::vector<double> all;
    for (const auto& observation : observations) {
      const double time = isStamped(*observation) ? seconds(observation->timestamp) : test::kNoTime;
      const bool isScan =
          observation->GetRuntimeClass()->className == std::string("mrpt::obs::CObservation2DRangeScan");
      all.push_back(std::round(1000 * (isScan ? time : -time)) / 1000);
    }
    return all;
  }
  OdometryClock clock{0};
};

TEST_F(OdometryClockTest, ScansWaitForLateOdometry) {
  clock = OdometryClock(-2);
  EXPECT_THAT(scan(10), IsEmpty());
  EXPECT_THAT(odometry(10), ElementsAre(-8));
  EXPECT_THAT(scan(11), IsEmpty());
  EXPECT_THAT(odometry(12.5), ElementsAre(10, -10.5));
  EXPECT_THAT(odometry(13), ElementsAre(-11, 11)) << "at equal times the odometry is first";
  EXPECT_THAT(scan(12), IsEmpty());
  EXPECT_THAT(scan(14), ElementsAre(12)) << "later odometry cannot be older";
  EXPECT_THAT(times(clock.finish()), ElementsAre(14));
  EXPECT_THAT(clock.finish(), IsEmpty());
}

TEST_F(OdometryClockTest, EarlyOdometryWaitsForTheScans) {
  clock = OdometryClock(2);
  EXPECT_THAT(odometry(10), IsEmpty());
  EXPECT_THAT(scan(10), ElementsAre(10));
  EXPECT_THAT(odometry(11), IsEmpty());
  EXPECT_THAT(scan(12), ElementsAre(-12, 12)) << "at equal times the odometry is first";
  EXPECT_THAT(odometry(14), ElementsAre(-13)) << "later scans cannot be older";
  EXPECT_THAT(times(clock.finish()), ElementsAre(-16));
}

TEST_F(OdometryClockTest, InTheOrderOfArrivalNothingWaits) {
  clock = OdometryClock(-2);
  for (int i = 0; i < 10; ++i) {
    EXPECT_THAT(odometry(12 + i), ElementsAre(-10 - i));
    EXPECT_THAT(scan(10 + i), ElementsAre(10 + i));
  }
}

TEST_F(OdometryClockTest, WithoutATimeOrAnOffsetNothingChanges) {
  const auto unstamped = test::odometry(test::kNoTime, {});
  EXPECT_THAT(OdometryClock(-2).take(unstamped), ElementsAre(unstamped));
  const auto stamped = test::odometry(5, {});
  EXPECT_THAT(OdometryClock(0).take(stamped), ElementsAre(stamped));
  EXPECT_THAT(OdometryClock(-2).take(stamped), testing::SizeIs(1));
  EXPECT_EQ(seconds(stamped->timestamp), 5) << "a recording has it as measured";
}

TEST_F(OdometryClockTest, TimesAreNotNegative) {
  clock = OdometryClock(-2);
  EXPECT_THAT(odometry(1), ElementsAre(0));
}

TEST_F(OdometryClockTest, AnObservationWithoutATimeFollowsTheOneBefore) {
  clock = OdometryClock(-2);
  EXPECT_THAT(scan(10), IsEmpty());
  EXPECT_THAT(scan(test::kNoTime), IsEmpty());
  EXPECT_THAT(odometry(13), testing::SizeIs(3));
  clock = OdometryClock(2);
  EXPECT_THAT(scan(test::kNoTime), testing::SizeIs(1));
}

TEST_F(OdometryClockTest, TimeThatStepsBackBeginsAnotherLog) {
  clock = OdometryClock(-2);
  EXPECT_THAT(scan(100), IsEmpty());
  EXPECT_THAT(scan(10), ElementsAre(100));
  EXPECT_THAT(odometry(12), ElementsAre(-10, 10));
}

TEST_F(OdometryClockTest, MemoryIsBounded) {
  clock = OdometryClock(-10);
  size_t continued = 0;
  for (int i = 0; i < 20'000; ++i) continued += scan(1e-4 * i).size();
  EXPECT_EQ(continued, 10'000u);

  clock = OdometryClock(-10);
  const auto large = test::scan(0);
  large->resizeScan(4'000'000);
  EXPECT_THAT(clock.take(large), IsEmpty());
  EXPECT_THAT(clock.take(large), IsEmpty());
  EXPECT_THAT(clock.take(large), testing::SizeIs(1));
}

}  // namespace
}  // namespace hybrid_slam::readings
