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

}  // namespace
}  // namespace hybrid_slam::readings
