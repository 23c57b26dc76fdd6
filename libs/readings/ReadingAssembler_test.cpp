#include "readings/ReadingAssembler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "testing/TestLogs.h"

namespace hybrid_slam::readings {
namespace {

using mrpt::math::TPose2D;
using test::odometry;
using test::scan;

/// Assembles the readings of a log of single observations.
std::vector<Reading> assembled(const test::Log& log, const SensorSettings& settings = {}) {
  ReadingAssembler assembler({}, OdometrySource::readings, 1, settings);
  std::vector<Reading> readings;
  const auto drain = [&] {
    while (auto reading = assembler.next()) readings.push_back(*reading);
  };
  for (const auto& object : log) {
    assembler.take(object);
    drain();
  }
  assembler.finish();
  drain();
  return readings;
}

TPose2D endOf(const std::vector<Reading>& readings) {
  TPose2D pose;
  for (const Reading& reading : readings) pose = pose + reading.motion;
  return pose;
}

/// Also of a clock that differs by more than the largest gap, and of scans after a gap.
TEST(ReadingAssembler, ATimeOffsetCorrectsTheOdometrysClock) {
  const auto drive = [](double late, bool isSorted) {
    std::vector<std::pair<double, test::Log::value_type>> timed;
    for (int i = 0; i < 200; ++i) {
      const double t = 1000 + 0.1 * i + (i < 120 ? 0 : 3);  // a gap
      const TPose2D pose(0.001 * i * i, 0.5 * std::sin(0.1 * i), 0.3 * std::sin(0.2 * i));
      timed.emplace_back(t + 0.05 + (isSorted ? late : 0), odometry(t + 0.05 + late, pose));
      timed.emplace_back(t, scan(t));
    }
    std::stable_sort(timed.begin(), timed.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    test::Log log;
    for (const auto& entry : timed) log.push_back(entry.second);
    return log;
  };
  const std::vector<Reading> right = assembled(drive(0, true));
  for (const double late : {-4.0, -0.7, 0.7, 4.0})
    for (const bool isSorted : {false, true}) {
      SensorSettings settings;
      settings.odometryTimeOffset = -late;
      const std::vector<Reading> readings = assembled(drive(late, isSorted), settings);
      ASSERT_EQ(readings.back().timestamp, right.back().timestamp);
      // Of a sorted log, the scans of the first or the last seconds have no odometry around them.
      for (size_t back = 50; back < 100; ++back) {
        const Reading &a = readings[readings.size() - back], &b = right[right.size() - back];
        EXPECT_EQ(a.timestamp, b.timestamp);
        EXPECT_NEAR((a.motion - b.motion).norm(), 0, 1e-6) << late << ' ' << isSorted << ' ' << a.timestamp;
        EXPECT_NEAR(a.motion.phi, b.motion.phi, 1e-6);
      }
    }
}

TEST(ReadingAssembler, OnlyTheLastScansBeforeTheFirstOdometryAreUsed) {
  test::Log log;
  for (int i = 0; i < 3000; ++i) log.push_back(scan(0.1 * i));
  log.push_back(odometry(300, {7, 0, 0}));
  log.push_back(scan(300));
  const std::vector<Reading> readings = assembled(log);
  ASSERT_EQ(readings.size(), 6u);
  EXPECT_NEAR(readings[0].timestamp, 299.5, 1e-6);
  for (const Reading& reading : readings) EXPECT_EQ(reading.motion, TPose2D());
}

/// Each of these scans takes 9 MB.
TEST(ReadingAssembler, LargeScansBeforeTheFirstOdometryFillNoMemory) {
  test::Log log;
  for (int i = 0; i < 16; ++i) {
    const int cycle = i / 4;
    const auto large = scan(0.1 * cycle, {}, 3, "LASER" + std::to_string(i % 4));
    large->resizeScan(1 << 20);
    log.push_back(large);
  }
  log.push_back(odometry(300, {7, 0, 0}));
  size_t beams = 0;
  for (const Reading& reading : assembled(log))
    for (const auto& each : reading.scans) beams += each->getScanSize();
  EXPECT_LE(beams, 11u << 20);
  EXPECT_GT(beams, 4u << 20);
}

/// At 1 m/s, whether the scan of 0.23 s comes in order, after newer odometry, or before older odometry.
TEST(ReadingAssembler, ALogInTheOrderOfArrival) {
  const auto at = [](double time) { return odometry(100 + time, {time, 0, 0}); };
  const auto seen = scan(100.23);
  const test::Log inOrder{at(0), scan(100), at(0.1), at(0.2), seen, at(0.3), at(0.4)},
      late{at(0), scan(100), at(0.1), at(0.2), at(0.3), seen, at(0.4)},
      early{at(0), scan(100), at(0.1), seen, at(0.2), at(0.3), at(0.4)};
  for (const test::Log& log : {inOrder, late, early}) {
    const std::vector<Reading> readings = assembled(log);
    ASSERT_EQ(readings.size(), 2u);
    EXPECT_NEAR(readings[1].motion.x, 0.23, 1e-6);
  }
}

TEST(ReadingAssembler, OdometryThatIsNotExpectedIsIgnored) {
  ReadingAssembler assembler({}, OdometrySource::actions, 1);
  for (const auto& object : test::Log{scan(1, {}, 3, "front"), odometry(1, {0, 0, 0}),
                                      odometry(1.1, {50, 0, 0}), scan(1.1, {}, 3, "rear")})
    assembler.take(object);
  assembler.finish();
  size_t scans = 0;
  for (auto reading = assembler.next(); reading; reading = assembler.next())
    for (const auto& taken : reading->scans) {
      EXPECT_EQ(taken->sensorPose.norm(), 0) << taken->sensorLabel;
      ++scans;
    }
  EXPECT_EQ(scans, 2u);
}

TEST(ReadingAssembler, ActionsDoNotAddToOdometryReadings) {
  test::Log log;
  for (int i = 0; i < 4; ++i) {
    log.push_back(odometry(1 + i, {1.0 * i, 0, 0}));
    log.push_back(test::action({i > 0 ? 1.0 : 0.0, 0, 0}));
    log.push_back(scan(1 + i));
  }
  EXPECT_NEAR(endOf(assembled(log)).x, 3, 1e-9);
}

/// Odometry that is wrong by steps below the limit of a jump does not place a laser far from its robot.
TEST(ReadingAssembler, OfScansFarApartTheLatestAreTheReading) {
  test::Log log{odometry(1, {0, 0, 0}), scan(1, {}, 3, "front"), scan(1, {}, 3, "rear")};
  for (int i = 1; i <= 40; ++i) {
    log.push_back(odometry(2 + 0.002 * i, {70.0 * i, 0, 0}));
    if (i == 1) log.push_back(scan(2.002, {}, 3, "front"));
  }
  log.push_back(scan(2.08, {}, 3, "rear"));
  const std::vector<Reading> readings = assembled(log);
  for (const Reading& reading : readings)
    for (const auto& taken : reading.scans) EXPECT_LE(taken->sensorPose.norm(), 10) << taken->sensorLabel;
  ASSERT_EQ(readings.size(), 3u) << "as many as ScanGrouper counts";
  ASSERT_EQ(readings[2].scans.size(), 1u);
  EXPECT_EQ(readings[2].scans[0]->sensorLabel, "rear");
  EXPECT_NEAR(endOf(readings).x, 38 * 70, 1e-6) << "the first steps count as jumps";
}

/// The reading after a wrong first one begins the path; map coordinates are no error.
/// The rear laser is known after the first reading only.
TEST(ReadingAssembler, ScansOfTwoLasersAtOneTimeAreOneReadingWhereverTheLogBegins) {
  for (const bool isRearFirst : {false, true}) {
    test::Log log;
    for (int i = 0; i < 20; ++i) {
      const double time = 0.8 * i;
      log.push_back(odometry(time, {0.5 * time, 0, 0}));
      const auto front = scan(time, {}, 3, "FRONT"), rear = scan(time, {}, 3, "REAR");
      if (isRearFirst && i > 0) log.push_back(rear);
      log.push_back(front);
      if (!isRearFirst) log.push_back(rear);
    }
    const std::vector<Reading> readings = assembled(log);
    size_t together = 0;
    for (const Reading& reading : readings)
      together += reading.scans.size() == 2 && reading.scans[0]->timestamp == reading.scans[1]->timestamp;
    EXPECT_GE(together, 18u) << isRearFirst;
    EXPECT_LE(readings.size(), 22u) << isRearFirst;
  }
}

TEST(ReadingAssembler, ImpossibleOdometryIsSkipped) {
  const auto readings = assembled(
      {odometry(1, {1e20, 0, 0}), scan(1), odometry(2, {5, 0, 0}), scan(2), odometry(3, {6, 0, 0}), scan(3)});
  ASSERT_EQ(readings.size(), 3u);
  EXPECT_EQ(readings[1].motion, TPose2D());
  EXPECT_NEAR(endOf(readings).x, 1, 1e-6);
  const auto utm = assembled({odometry(1, {5e6, 4e5, 0}), scan(1), odometry(2, {5e6 + 1, 4e5, 0}), scan(2)});
  EXPECT_NEAR(endOf(utm).x, 1, 1e-6);
}

/// Each sensor has its own frame.
TEST(ReadingAssembler, OdometryOfASecondSensorIsIgnored) {
  test::Log log;
  for (int i = 0; i < 10; ++i) {
    const auto visual = odometry(10.05 + 0.1 * i, {-3, 0.1 * i, 1});
    visual->sensorLabel = "VISUAL";
    for (const auto& each : test::Log{odometry(10 + 0.1 * i, {0.1 * i, 0, 0}), scan(10 + 0.1 * i), visual})
      log.push_back(each);
  }
  const auto readings = assembled(log);
  ASSERT_EQ(readings.size(), 10u);
  for (size_t i = 1; i < readings.size(); ++i) {
    EXPECT_NEAR(readings[i].motion.x, 0.1, 1e-6);
    EXPECT_NEAR(readings[i].motion.y, 0, 1e-6);
  }
}

/// Counters that restart, and an outlier.
TEST(ReadingAssembler, JumpsFasterThanTheRobotAreNoMotion) {
  test::Log log;
  for (int i = 0; i < 40; ++i) {
    const double x = i < 20 ? 3 + 0.05 * i : 0.05 * (i - 20);
    log.push_back(odometry(0.1 * i, {i == 10 ? -20 : x, 0, i < 20 ? 0.0 : 1.0}));
    log.push_back(scan(0.1 * i));
  }
  const auto readings = assembled(log);
  for (const Reading& reading : readings) EXPECT_LT(reading.motion.norm(), 0.06);
  EXPECT_NEAR(endOf(readings).x, 17 * 0.05 + 19 * 0.05 * std::cos(1), 1e-6);
}

/// A copy of a scan at a later time.
mrpt::obs::CObservation2DRangeScan::Ptr again(const mrpt::obs::CObservation2DRangeScan& scan, double time) {
  auto copy = mrpt::obs::CObservation2DRangeScan::Create(scan);
  copy->timestamp = test::stamp(time);
  return copy;
}

TEST(ReadingAssembler, ALaserThatRepeatsItsScanWhileTheRobotMovesIsNotUsed) {
  const auto first = scan(1);
  const std::vector<Reading> readings = assembled(
      {odometry(1, {0, 0, 0}), first, odometry(2, {0, 0, 0}), again(*first, 2), odometry(3, {0.5, 0, 0}),
       again(*first, 3), odometry(4, {0.5, 0, 0.1}), again(*first, 4), odometry(5, {1, 0, 0.1}), scan(5)});
  std::vector<size_t> scans;
  for (const Reading& reading : readings) scans.push_back(reading.scans.size());
  EXPECT_EQ(scans, (std::vector<size_t>{1, 1, 0, 0, 1})) << "a robot that stands may see the same twice";
  EXPECT_NEAR(readings[2].timestamp, 3, 1e-6);
  EXPECT_NEAR(readings[2].motion.x, 0.5, 1e-9);
  EXPECT_NEAR(endOf(readings).x, 1, 1e-9) << "no motion is lost";
  EXPECT_NEAR(readings[2].way, 0.5, 1e-9);
}

TEST(ReadingAssembler, TheWayOfAReadingIsAlongTheOdometry) {
  test::Log log{odometry(1, {0, 0, 0}), scan(1)};
  for (int i = 0; i < 100; ++i) log.push_back(odometry(2 + 0.1 * i, {0.01 * (i % 2), 0, 0}));  // trembles
  log.push_back(scan(11.9));
  for (int i = 1; i <= 20; ++i) log.push_back(odometry(12 + i, {i <= 10 ? 1. * i : 20. - i, 0, 0}));
  log.push_back(scan(32));
  const std::vector<Reading> readings = assembled(log);
  ASSERT_EQ(readings.size(), 3u);
  EXPECT_EQ(readings[1].way, 0);
  EXPECT_NEAR(readings[2].way, 20, 1e-9) << "out and back";
  EXPECT_LT(readings[2].motion.norm(), 0.02);
}

TEST(ReadingAssembler, TheScansOfOtherLasersAreUsedWhileOneRepeatsItsOwn) {
  const auto first = scan(1, {}, 181, "FRONT");
  const std::vector<Reading> readings =
      assembled({odometry(1, {0, 0, 0}), test::frame({first, scan(1, {}, 181, "REAR")}),
                 odometry(2, {1, 0, 0}), test::frame({again(*first, 2), scan(2, {}, 181, "REAR")})});
  ASSERT_EQ(readings.size(), 2u);
  ASSERT_EQ(readings[1].scans.size(), 1u);
  EXPECT_EQ(readings[1].scans[0]->sensorLabel, "REAR");
  EXPECT_EQ(readings[0].repeating, std::nullopt);
  EXPECT_EQ(readings[1].repeating, "FRONT");
}

TEST(ReadingAssembler, InTheOpenEqualScansAreUsed) {
  const auto first = scan(1);
  for (size_t i = 9; i < first->getScanSize(); ++i) first->setScanRangeValidity(i, false);
  const std::vector<Reading> readings =
      assembled({odometry(1, {0, 0, 0}), first, odometry(2, {1, 0, 0}), again(*first, 2)});
  ASSERT_EQ(readings.size(), 2u);
  EXPECT_EQ(readings[1].scans.size(), 1u);
}

}  // namespace
}  // namespace hybrid_slam::readings
