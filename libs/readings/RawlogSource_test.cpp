#include "readings/RawlogSource.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/Errors.h"
#include "files/TemporaryFolder.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::readings {
namespace {

using mrpt::obs::CObservation2DRangeScan;
using test::action;
using test::frame;
using test::kNoTime;
using test::Log;
using test::odometry;
using test::scan;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Result of a log: its summary, and each scan's odometry pose relative to the first.
struct Replayed {
  RawlogSummary summary;
  std::vector<double> times, x, phi;
  std::vector<size_t> entries;                      ///< log entries read when each scan was returned
  std::vector<CObservation2DRangeScan::Ptr> scans;  ///< the latest of each reading
  std::vector<Scans> readings;
  std::vector<std::vector<size_t>> sizes;  ///< beams of the scans of each reading
  std::vector<mrpt::math::TPose2D> poses;  ///< by odometry, from that of the first reading
  std::string error;
};

Replayed replayed(const test::Log& log, const InputOptions& options = {}, bool isGzipped = false) {
  const files::TemporaryFolder folder;
  const std::string path = folder.path("log");
  isGzipped ? test::writeGzipped(path, log) : test::writePlain(path, log);
  Replayed out;
  try {
    out.summary = summarise(path, options);
  } catch (const InputError& e) {
    out.error = e.what();
    return out;
  }
  RawlogSource source(path, options, out.summary);
  mrpt::math::TPose2D pose;
  while (const auto reading = source.next()) {
    pose = pose + reading->motion;
    out.times.push_back(reading->timestamp);
    out.x.push_back(pose.x);
    out.phi.push_back(pose.phi);
    out.entries.push_back(source.entry());
    out.scans.push_back(reading->scans.back());
    out.readings.push_back(reading->scans);
    out.sizes.emplace_back();
    for (const auto& s : reading->scans) out.sizes.back().push_back(s->getScanSize());
    out.poses.push_back(pose);
  }
  EXPECT_EQ(out.times.size(), out.summary.scans) << "the summary gives the number of scans";
  EXPECT_EQ(source.entry(), out.summary.entries);
  EXPECT_FALSE(source.next()) << "an end stays an end";
  return out;
}

auto areNear(const std::vector<double>& expected) {
  std::vector<testing::Matcher<double>> each;
  for (const double value : expected) each.push_back(testing::DoubleNear(value, 1e-6));
  return testing::ElementsAreArray(each);
}

TEST(RawlogSource, ActionObservationPairsSumUpTheOdometry) {
  const test::Log log{test::action({1, 0, 0}), test::frame({scan(10)}),        test::action({1, 0, M_PI / 2}),
                      test::frame({scan(11)}), test::action({0, 0, M_PI / 4}), test::action({1, 0, 0}),
                      test::frame({scan(12)})};
  for (const bool isGzipped : {false, true}) {
    const Replayed r = replayed(log, {}, isGzipped);
    EXPECT_THAT(r.times, areNear({10, 11, 12}));
    EXPECT_THAT(r.x, areNear({0, 1, 1 - std::sqrt(0.5)}))
        << "the distance before the first scan is not counted";
    EXPECT_THAT(r.phi, areNear({0, M_PI / 2, 3 * M_PI / 4}));
    EXPECT_TRUE(r.summary.hasActions);
    EXPECT_FALSE(r.summary.hasOdometryReadings);
    EXPECT_EQ(r.summary.entries, 7u);
    EXPECT_NEAR(r.summary.duration, 2, 1e-6);
  }
}

TEST(RawlogSource, OdometryIsInterpolatedAtTheScansOwnTime) {
  const test::Log log{test::odometry(10, {0, 0, 0}),
                      scan(10),
                      scan(10.25),
                      scan(10.5),
                      scan(10.75),
                      test::odometry(11, {1, 0, 0.4}),
                      scan(11),
                      scan(11.5),
                      test::odometry(12, {3, 0, 0.4})};
  for (const bool isGzipped : {false, true}) {
    const Replayed r = replayed(log, {}, isGzipped);
    EXPECT_THAT(r.times, areNear({10, 10.25, 10.5, 10.75, 11, 11.5}));
    EXPECT_THAT(r.x, areNear({0, 0.25, 0.5, 0.75, 1, 2}));
    EXPECT_THAT(r.phi, areNear({0, 0.1, 0.2, 0.3, 0.4, 0.4}));
  }
}

TEST(RawlogSource, HeadingsAreInterpolatedTheShorterWay) {
  const Replayed r = replayed({test::odometry(0, {0, 0, 0}), scan(0), test::odometry(1, {0, 0, M_PI - 0.1}),
                               scan(1.5), test::odometry(2, {0, 0, -M_PI + 0.1}), scan(2)});
  EXPECT_THAT(std::abs(r.phi[1]), testing::DoubleNear(M_PI, 1e-6));
  EXPECT_NEAR(r.phi[2], -M_PI + 0.1, 1e-6);
}

TEST(RawlogSource, MotionIsInTheRobotsFrame) {
  const files::TemporaryFolder folder;
  const std::string path = test::writePlain(
      folder.path("log"),
      {test::odometry(0, {5, 5, M_PI / 2}), scan(0), test::odometry(1, {5, 7, M_PI / 2}), scan(1)});
  RawlogSource source(path, {}, summarise(path, {}));
  const auto first = source.next()->motion, second = source.next()->motion;
  EXPECT_EQ(first, mrpt::math::TPose2D(0, 0, 0));
  EXPECT_NEAR(second.x, 2, 1e-9);
  EXPECT_NEAR(second.y, 0, 1e-9);
}

TEST(RawlogSource, ScansBeforeTheFirstOdometryHaveItsPose) {
  for (const double time : {9., test::kNoTime}) {
    const Replayed r = replayed({scan(time), scan(time), test::odometry(10, {7, 0, 0}), scan(10),
                                 test::odometry(11, {8, 0, 0}), scan(11)});
    EXPECT_THAT(r.x, areNear({0, 0, 0, 1})) << "no jump from the origin to the first reading";
  }
}

TEST(RawlogSource, ScansAfterTheLastOdometryHaveItsPose) {
  const Replayed r = replayed(
      {test::odometry(10, {0, 0, 0}), scan(10), test::odometry(11, {1, 0, 0}), scan(11.2), scan(11.4)});
  EXPECT_THAT(r.x, areNear({0, 1, 1}));
}

TEST(RawlogSource, EqualTimestamps) {
  const Replayed r =
      replayed({test::odometry(10, {0, 0, 0}), scan(10), scan(10), test::odometry(10, {1, 0, 0}), scan(10),
                test::odometry(10, {2, 0, 0}), test::odometry(10, {3, 0, 0}), scan(10)});
  EXPECT_THAT(r.x, areNear({0, 0, 1, 3})) << "log order kept";
  EXPECT_EQ(r.summary.repeatedStamps.count, 3u);
  EXPECT_EQ(r.summary.repeatedStamps.first, 3u);
  EXPECT_EQ(r.summary.stepsBack.count, 0u);
}

TEST(RawlogSource, TimestampsSteppingBackKeepTheOrderOfTheLog) {
  const Replayed r = replayed({test::odometry(10, {0, 0, 0}), scan(10), test::odometry(11, {1, 0, 0}),
                               scan(10.5), test::odometry(10.8, {2, 0, 0}), scan(10.9),
                               test::odometry(10.7, {3, 0, 0}), scan(11.5), test::odometry(11.6, {4, 0, 0})});
  EXPECT_THAT(r.times, areNear({10, 10.5, 10.9, 11.5}));
  EXPECT_THAT(r.x, areNear({0, 1, 2, 3 + 0.8 / 0.9}));
  EXPECT_EQ(r.summary.stepsBack.count, 0u);
  const Replayed back = replayed(
      {test::odometry(10, {0, 0, 0}), scan(10), test::odometry(12, {1, 0, 0}), scan(12), scan(11), scan(13)});
  EXPECT_THAT(back.times, areNear({10, 12, 11, 13}));
  EXPECT_EQ(back.summary.stepsBack.count, 1u);
  EXPECT_EQ(back.summary.stepsBack.first, 5u);
  EXPECT_NEAR(back.summary.duration, 3, 1e-6);
}

TEST(RawlogSource, MissingTimestamps) {
  const Replayed r = replayed({test::odometry(10, {0, 0, 0}), scan(10), test::odometry(11, {1, 0, 0}),
                               scan(test::kNoTime), test::odometry(12, {2, 0, 0}), scan(12)});
  EXPECT_THAT(r.times, areNear({10, 10, 12})) << "that of the previous scan";
  EXPECT_THAT(r.x, areNear({0, 1, 2}));
  EXPECT_EQ(r.summary.unstamped.count, 1u);
  EXPECT_EQ(r.summary.unstamped.first, 4u);

  const Replayed none = replayed({test::odometry(test::kNoTime, {0, 0, 0}), scan(test::kNoTime),
                                  test::odometry(test::kNoTime, {1, 0, 0}), scan(test::kNoTime)});
  EXPECT_THAT(none.times, areNear({0, 0}));
  EXPECT_THAT(none.x, areNear({0, 1}));
  EXPECT_EQ(none.summary.duration, 0);

  const Replayed unstampedOdometry = replayed({test::odometry(test::kNoTime, {0, 0, 0}), scan(10),
                                               test::odometry(test::kNoTime, {1, 0, 0}), scan(11)});
  EXPECT_THAT(unstampedOdometry.x, areNear({0, 1}));
}

TEST(RawlogSource, AnUnstampedScanDoesNotOvertakeAWaitingOne) {
  const Replayed r = replayed({test::odometry(10, {0, 0, 0}), scan(10.5, {}, 3), scan(test::kNoTime, {}, 4),
                               test::odometry(11, {1, 0, 0})});
  ASSERT_EQ(r.scans.size(), 2u);
  EXPECT_EQ(r.scans[0]->getScanSize(), 3u);
  EXPECT_THAT(r.x, areNear({0, -0.5}));
}

TEST(RawlogSource, AcrossALargeGapThePreviousOdometryIsUsed) {
  const test::Log log{test::odometry(10, {0, 0, 0}), scan(10), scan(10.5), test::odometry(11.5, {3, 0, 0}),
                      scan(11.5)};
  EXPECT_THAT(replayed(log).x, areNear({0, 0, 3}));
  InputOptions options;
  options.maxOdometryGap = 1.5;
  EXPECT_THAT(replayed(log, options).x, areNear({0, 1, 3}));
}

TEST(RawlogSource, MemoryDoesNotGrowWhereOdometryEnds) {
  test::Log log{test::odometry(0, {0, 0, 0})};
  for (int i = 0; i < 100; ++i) log.push_back(scan(0.1 * i));
  const Replayed r = replayed(log);
  for (size_t i = 0; i < r.entries.size(); ++i) EXPECT_LE(r.entries[i], i + 14) << "within the gap of 1 s";
}

TEST(RawlogSource, MemoryDoesNotGrowWhereTimeStandsStill) {
  test::Log log{test::odometry(0, {0, 0, 0})};
  for (int i = 0; i < 3000; ++i) log.push_back(scan(0.5));
  const Replayed r = replayed(log);
  ASSERT_EQ(r.entries.size(), 3000u);
  for (size_t i = 0; i < r.entries.size(); ++i) EXPECT_LE(r.entries[i], i + 1010);
}

/// Two lasers in sensory frames: by default both are used, otherwise the named ones.
TEST(RawlogSource, ReadingsHaveTheScansOfAllLasers) {
  const test::Log log{
      test::action({0, 0, 0}), test::frame({scan(10, {}, 3, "front"), scan(10, {}, 4, "rear")}),
      test::action({1, 0, 0}), test::frame({scan(11, {}, 4, "rear")}),
      test::action({1, 0, 0}), test::frame({scan(12, {}, 4, "rear"), scan(12, {}, 3, "front")})};
  const Replayed all = replayed(log);
  EXPECT_THAT(all.summary.lasers, testing::ElementsAre("front", "rear"));
  EXPECT_THAT(all.summary.ignored, testing::IsEmpty());
  EXPECT_THAT(all.x, areNear({0, 1, 2}));
  EXPECT_THAT(all.sizes, testing::ElementsAre(testing::ElementsAre(3, 4), testing::ElementsAre(4),
                                              testing::ElementsAre(4, 3)));
  InputOptions options;
  options.sensorLabel = "rear";
  const Replayed rear = replayed(log, options);
  EXPECT_THAT(rear.times, areNear({10, 11, 12}));
  EXPECT_THAT(rear.x, areNear({0, 1, 2}));
  EXPECT_THAT(rear.summary.ignored,
              testing::ElementsAre("laser `front` is not used: not in [input] sensor_label"));
  options.sensorLabel = " rear ,front";
  EXPECT_EQ(replayed(log, options).sizes, all.sizes);
  options.sensorLabel = "rear, side";
  EXPECT_THAT(replayed(log, options).error, HasSubstr("no scans of the laser `side`"));
  EXPECT_THAT(replayed(log, options).error, HasSubstr("sensor_label: the log has `front`, `rear`"));
}

/// The front and the rear laser scan alternately while the robot drives and turns. The earlier scan is placed
/// by the robot pose of its time, so that all end points lie on the room's walls.
TEST(RawlogSource, ScansOfOneReadingArePlacedByTheOdometryBetweenThem) {
  test::Log log;
  for (int i = 0; i < 12; ++i) {
    const double time = 10 + 0.1 * i;
    const mrpt::math::TPose2D pose(0.1 * i, 0.02 * i, 0.05 * i);
    log.push_back(test::odometry(time, pose));
    log.push_back(scan(time, pose, 181, i % 2 == 0 ? "front" : "rear"));
  }
  const Replayed r = replayed(log);
  ASSERT_EQ(r.sizes.size(), 7u);
  EXPECT_THAT(r.sizes[0], testing::ElementsAre(181)) << "the second laser is not known yet";
  EXPECT_THAT(r.sizes[1], testing::ElementsAre(181, 181));
  EXPECT_THAT(r.sizes.back(), testing::ElementsAre(181)) << "the end of the log ends a reading";
  for (size_t i = 0; i < r.readings.size(); ++i)
    for (const auto& taken : r.readings[i]) {
      const LaserScan seen = toLaserScan(*taken, 100);
      for (const Beam& beam : seen.beams) {
        const auto end = r.poses[i].composePoint(seen.sensorPose.composePoint(
            {beam.range * std::cos(beam.angle), beam.range * std::sin(beam.angle)}));
        ASSERT_LT(std::min(std::abs(std::abs(end.x) - test::kHalfLength),
                           std::abs(std::abs(end.y) - test::kHalfWidth)),
                  1e-4);
      }
    }
}

TEST(RawlogSource, TiltedLasersAreIgnoredUnlessNamed) {
  const auto tilted = [](double time) {
    auto s = scan(time, {}, 5, "tilted");
    s->sensorPose = mrpt::poses::CPose3D(0, 0, 1, 0, 0.5, 0);
    return s;
  };
  const test::Log log{test::odometry(10, {}), tilted(10), scan(10),
                      tilted(10.1),           scan(10.1), test::odometry(11, {})};
  const Replayed r = replayed(log);
  EXPECT_THAT(r.summary.lasers, testing::ElementsAre("LASER"));
  EXPECT_THAT(r.summary.ignored,
              testing::ElementsAre("laser `tilted` is not used: its scan plane is tilted"));
  EXPECT_EQ(r.summary.tilted.count, 2u);
  EXPECT_EQ(r.times.size(), 2u);
  EXPECT_THAT(replayed({test::odometry(10, {}), tilted(10)}).error,
              HasSubstr("the laser's scan plane is tilted: sensor `tilted`"));
}

/// `RAWLASER1` and `ROBOTLASER1` are rows of one laser.
TEST(RawlogSource, LasersOfATextLogWhoseRowsAreSkippedAreIgnored) {
  const files::TemporaryFolder folder;
  const std::string values = " 0 -1.0 2.0 0.5 30.0 0.01 0 3 4 5 6 0 ", time = "100.25 host 7.5\n";
  const std::string path =
      folder.write("log", "RAWLASER1" + values + time + "ROBOTLASER1" + values + "0 0 0 0 0 0 0 0 0 0 0 " +
                              time + "RAWLASER2" + values + time + "LASER3 3 1 2 3 " + time);
  const RawlogSummary summary = summarise(path, {});
  EXPECT_THAT(summary.lasers, ElementsAre("ROBOTLASER1"));
  EXPECT_THAT(
      summary.ignored,
      ElementsAre("laser `LASER3` is not used: the log does not state its pose on the robot",
                  "laser `RAWLASER2` is not used: its rows lack the robot's pose, unlike those of other "
                  "lasers"));
}

TEST(RawlogSource, EveryScanOfAFrameIsUsed) {
  const Replayed r = replayed({test::action({1, 0, 0}), test::frame({scan(10), scan(10.1)}),
                               test::action({1, 0, 0}), test::frame({scan(11)})});
  EXPECT_THAT(r.times, areNear({10, 10.1, 11}));
  EXPECT_THAT(r.x, areNear({0, 0, 1}));
}

TEST(RawlogSource, OdometryInsideOfFrames) {
  test::Log log;
  for (int i = 0; i < 3; ++i) {
    auto both = test::frame({});
    both->insert(test::odometry(10 + i, {2. * i, 0, 0}));
    both->insert(scan(10.5 + i));
    log.push_back(both);
  }
  EXPECT_THAT(replayed(log).x, areNear({0, 2, 3}));
}

TEST(RawlogSource, ScansWithoutBeamsAreSkipped) {
  const Replayed r =
      replayed({test::odometry(10, {0, 0, 0}), scan(10, {}, 0), scan(10.5), test::odometry(11, {1, 0, 0}),
                scan(11, {}, 0), test::frame({scan(11, {}, 0), scan(11)})});
  EXPECT_THAT(r.times, areNear({10.5, 11}));
  EXPECT_EQ(r.summary.empty.count, 3u);
  EXPECT_EQ(r.summary.empty.first, 2u);
  EXPECT_THAT(replayed({test::odometry(1, {}), scan(1, {}, 0)}).error,
              HasSubstr("all scans are of zero length"));
}

TEST(RawlogSource, NoOdometry) {
  const test::Log log{scan(10), scan(11), scan(12)};
  EXPECT_THAT(replayed(log).x, areNear({0, 0, 0}));
  EXPECT_THAT(replayed(log).entries, ElementsAre(1u, 2u, 3u)) << "scans do not wait";
  EXPECT_FALSE(replayed(log).summary.hasMotion);
  const test::Log withOdometry{test::odometry(1, {}), scan(1), test::odometry(2, {1, 0, 0}), scan(2)};
  EXPECT_THAT(replayed(withOdometry).x, areNear({0, 1}));
  EXPECT_TRUE(replayed(withOdometry).summary.hasMotion);
  const test::Log standing{test::action({}), test::frame({scan(1)}), test::action({}),
                           test::frame({scan(2)})};
  EXPECT_TRUE(replayed(standing).summary.hasActions);
  EXPECT_FALSE(replayed(standing).summary.hasMotion);
}

TEST(RawlogSource, EmptyActionsAreNoOdometry) {
  const auto nothing = mrpt::obs::CActionCollection::Create();
  EXPECT_FALSE(replayed({nothing, test::frame({scan(1)})}).summary.hasActions);
  const Replayed r = replayed({nothing, test::frame({scan(1)}), test::action({1, 0, 0}),
                               test::frame({scan(2)}), nothing, test::frame({scan(3)})});
  EXPECT_THAT(r.x, areNear({0, 1, 1}));
}

TEST(RawlogSource, OdometryThatIsNotFiniteIsIgnored) {
  const Replayed r =
      replayed({test::odometry(10, {kNaN, 0, 0}), test::odometry(10, {0, 0, 0}), scan(10),
                test::odometry(11, {1, kNaN, 0}), scan(11), test::odometry(12, {HUGE_VAL, 0, 0}),
                test::odometry(12, {2, 0, 0}), scan(12)});
  EXPECT_THAT(r.x, areNear({0, 0, 2}));
  EXPECT_EQ(r.summary.wrongOdometry.count, 3u);
  EXPECT_EQ(r.summary.wrongOdometry.first, 1u);
  EXPECT_FALSE(replayed({test::odometry(10, {kNaN, 0, 0}), scan(10)}).summary.hasOdometryReadings);
  EXPECT_THAT(replayed({test::action({1, 0, 0}), test::frame({scan(1)}), test::action({kNaN, 0, 0}),
                        test::frame({scan(2)})})
                  .x,
              areNear({0, 0}));
}

TEST(RawlogSource, ScansWithoutAFinitePoseAreSkipped) {
  const auto noAperture = scan(1), noPlace = scan(2);
  noAperture->aperture = static_cast<float>(kNaN);
  noPlace->sensorPose.x(kNaN);
  const Replayed r =
      replayed({test::action({}), test::frame({noAperture}), test::frame({noPlace}), test::frame({scan(3)})});
  EXPECT_THAT(r.times, areNear({3}));
  EXPECT_EQ(r.summary.empty.count, 2u);
}

TEST(RawlogSource, NoLaser) {
  EXPECT_THAT(replayed({test::odometry(1, {}), test::odometry(2, {})}).error, HasSubstr("no laser scans"));
}

TEST(RawlogSource, InvalidReadingsAreMarked) {
  const auto odd = scan(1, {}, 8);
  const float values[] = {static_cast<float>(kNaN), HUGE_VALF, -HUGE_VALF, -1, 0, 20, 25, 19.9f};
  for (size_t i = 0; i < 8; ++i) odd->setScanRange(i, values[i]);
  const Replayed r = replayed({test::action({}), test::frame({odd})});
  for (size_t i = 0; i < 8; ++i) EXPECT_EQ(r.scans[0]->getScanRangeValidity(i), i == 7) << i;
}

}  // namespace
}  // namespace hybrid_slam::readings
