/// The scans of a log that are used, and the readings that they make.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "files/TemporaryFolder.h"
#include "testing/ReplayedLog.h"

namespace hybrid_slam::readings {
namespace {

using test::areNear;
using test::kNaN;
using test::Replayed;
using test::replayed;
using test::scan;
using testing::ElementsAre;
using testing::HasSubstr;

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
  for (size_t i = 0; i < r.allScans.size(); ++i)
    for (const auto& taken : r.allScans[i]) {
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
