#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "files/TemporaryFolder.h"
#include "readings/RawlogSource.h"
#include "testing/ReplayedLog.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::readings {
namespace {

using test::replayed;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(RawlogSummary, CanBeStopped) {
  const files::TemporaryFolder folder;
  const std::string log = test::writePlain(folder.path("laps.rawlog"), test::laps(10));
  int asked = 0;
  EXPECT_THROW(summarise(log, {}, [&] { return ++asked == 3; }), std::runtime_error);
  EXPECT_EQ(asked, 3);
}

TEST(RawlogSummary, ATruncatedLogGivesItsReadablePart) {
  const files::TemporaryFolder folder;
  std::vector<size_t> ends;
  const std::string bytes = test::contentOf(test::writePlain(folder.path("whole"), test::laps(10), &ends));
  const std::string path = folder.write("cut", bytes.substr(0, ends[11] + 40));
  const RawlogSummary summary = summarise(path, {});
  EXPECT_EQ(summary.entries, 12u);
  EXPECT_EQ(summary.scans, 6u);
  EXPECT_THAT(summary.defect, HasSubstr("cut off"));
  RawlogSource source(path, {}, summary);
  size_t scans = 0;
  while (source.next()) ++scans;
  EXPECT_EQ(scans, 6u);
}

TEST(RawlogSummary, ALaserThatSeesAllAroundShouldHaveAScanTime) {
  const auto turning = [](double time) {
    auto all = test::scan(time);
    all->aperture = static_cast<float>(2 * M_PI);
    return all;
  };
  const test::Log log{test::odometry(1, {}), turning(1), test::odometry(2, {1, 0, 0}), turning(2)};
  EXPECT_THAT(replayed(log).summary.spinning, ElementsAre("LASER"));
  readings::InputOptions options;
  options.scanTime = 0;
  EXPECT_TRUE(replayed(log, options).summary.spinning.empty());
  EXPECT_TRUE(replayed({test::scan(1), test::scan(2)}).summary.spinning.empty());
}

/// Its odometry is stamped 3 s late, so that 30 scans come before the first reading.
TEST(RawlogSummary, WithATimeOffsetFewerScansAreEarly) {
  test::Log log;
  for (int i = 0; i < 130; ++i) {
    const double time = 1000 + 0.1 * i;
    if (i >= 30) log.push_back(test::odometry(time, {0.1 * (i - 30), 0, 0}));
    log.push_back(test::scan(time, {}, 3));
  }
  InputOptions options;
  const test::Replayed without = test::replayed(log, options);
  EXPECT_EQ(without.summary.early.count, 25u);
  options.odometryTimeOffset = -3;
  const test::Replayed r = test::replayed(log, options);  // expects as many readings as `scans` says
  EXPECT_EQ(r.summary.scans, 130u);
  EXPECT_NEAR(r.x[20], 2, 1e-6);

  RawlogSummary adapted = without.summary;
  const files::TemporaryFolder folder;
  adapted.adapt(test::writeGzipped(folder.path("log.rawlog"), log), options);
  EXPECT_EQ(adapted.scans, 130u);
  EXPECT_EQ(adapted.early.count, 0u);
}

TEST(RawlogSummary, WithATimeOffsetTheScansOfTwoLasersFormTheSameReadings) {
  test::Log log;
  for (int i = 0; i < 60; ++i) {
    const double time = 1000 + 0.1 * i;
    log.push_back(test::odometry(time, {0.1 * i, 0, 0}));
    if (i > 3) log.push_back(test::scan(time + 0.02, {}, 3, "FRONT"));
    log.push_back(i == 20 ? test::scan(test::kNoTime, {}, 3, "REAR")
                          : test::scan(time + 0.05, {}, 3, "REAR"));
  }
  InputOptions options;
  const test::Replayed without = test::replayed(log);
  for (const double offset : {-2.0, -0.05, 0.05, 2.0}) {
    options.odometryTimeOffset = offset;
    const test::Replayed r = test::replayed(log, options);  // expects as many readings as `scans` says
    EXPECT_EQ(r.summary.scans + r.summary.early.count, without.summary.scans);
    RawlogSummary adapted = without.summary;
    const files::TemporaryFolder folder;
    adapted.adapt(test::writeGzipped(folder.path("log.rawlog"), log), options);
    EXPECT_EQ(adapted.scans, r.summary.scans);
    EXPECT_EQ(adapted.early.count, r.summary.early.count);
    EXPECT_EQ(adapted.early.first, 2u) << "the first scan";
  }
}

}  // namespace
}  // namespace hybrid_slam::readings
