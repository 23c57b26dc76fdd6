#include "live/RawlogPlayer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "base/Errors.h"
#include "files/TemporaryFolder.h"
#include "readings/ReadingAssembler.h"
#include "testing/ErrorOf.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::live {
namespace {

using mrpt::obs::CSensoryFrame;
using test::Log;

constexpr double kFast = 100000;  // cycles/s

/// The readings that a live run assembles from a log, and their cycles.
struct Played {
  std::vector<readings::Reading> readings;
  size_t cycles = 0;
};

Played played(const test::Log& log, double cycleRate, size_t stopAfter = 1000000) {
  const files::TemporaryFolder folder;
  RawlogPlayer player(test::writePlain(folder.path("log"), log), cycleRate, kFast);
  Played out;
  readings::ReadingAssembler assembler({}, readings::OdometrySource::readings, 1);
  player.run(
      [&](const CSensoryFrame::Ptr& cycle) {
        ++out.cycles;
        assembler.take(cycle);
      },
      [&] { return out.cycles >= stopAfter; });
  assembler.finish();
  while (const auto reading = assembler.next()) out.readings.push_back(*reading);
  return out;
}

TEST(RawlogPlayer, DeliversEveryScanOfALogWithItsMotion) {
  const Played p = played(test::laps(50), 5);
  ASSERT_EQ(p.readings.size(), 50u);
  EXPECT_EQ(p.cycles, 50u);
  for (size_t i = 1; i < 50; ++i)
    EXPECT_LT((p.readings[i].motion - (test::poseOnLap(i, 80) - test::poseOnLap(i - 1, 80))).norm(), 1e-6);
}

TEST(RawlogPlayer, ALogThatIsShortenedWhileItIsServedIsAnError) {
  const files::TemporaryFolder folder;
  const std::string file = test::writePlain(folder.path("log"), test::laps(500));
  RawlogPlayer player(file, 5, kFast);
  size_t cycles = 0;
  const auto play = [&] {
    player.run(
        [&](const CSensoryFrame::Ptr&) {
          if (++cycles == 1) std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
        },
        [] { return false; });
  };
  EXPECT_THAT(test::errorOf<std::runtime_error>(play),
              testing::MatchesRegex("log has changed while it was served: entry [0-9]+ of " + file + ".*"));
  EXPECT_LT(cycles, 500u);
}

TEST(RawlogPlayer, SaysWhatIsWrongWithTheLog) {
  const files::TemporaryFolder folder;
  test::Log log = test::laps(20);
  std::dynamic_pointer_cast<mrpt::obs::CObservation>(log[11])->timestamp =
      std::dynamic_pointer_cast<mrpt::obs::CObservation>(log[9])->timestamp;
  const std::string file = test::writeGzipped(folder.path("log"), log);
  EXPECT_THAT(RawlogPlayer(file, 5, kFast).warnings(),
              testing::ElementsAre("1 timestamp equal to that of the previous scan: first at entry 12 of " +
                                   file + "; kept"));
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  RawlogPlayer cut(file, 5, kFast);
  EXPECT_THAT(cut.warnings().back(), testing::HasSubstr("served up to this point"));
  size_t cycles = 0;
  EXPECT_EQ(test::errorOf<std::runtime_error>(
                [&] { cut.run([&](const auto&) { ++cycles; }, [] { return false; }); }),
            cut.warnings().back());
  EXPECT_GT(cycles, 5u) << "what is there is served first";
}

TEST(RawlogPlayer, ThinsAFastLog) {
  test::Log log;
  for (int i = 0; i < 100; ++i) {  // 50 scans/s for 2 s
    log.push_back(test::odometry(10 + 0.02 * i, {0.01 * i, 0, 0}));
    log.push_back(test::scan(10 + 0.02 * i));
  }
  EXPECT_NEAR(static_cast<double>(played(log, 5).readings.size()), 10, 1);
  EXPECT_EQ(played(log, 0).readings.size(), 100u);
}

TEST(RawlogPlayer, TheActionsOfPairsBecomeOdometry) {
  const test::Log log{test::action({1, 0, 0}),        test::frame({test::scan(10)}),
                      test::action({1, 0, M_PI / 2}), test::frame({test::scan(11)}),
                      test::action({2, 0, 0}),        test::frame({test::scan(12)})};
  const Played p = played(log, 5);
  ASSERT_EQ(p.readings.size(), 3u);
  EXPECT_NEAR(p.readings[1].motion.x, 1, 1e-9);
  EXPECT_NEAR(p.readings[1].motion.phi, M_PI / 2, 1e-9);
  EXPECT_NEAR(p.readings[2].motion.x, 2, 1e-9);
  EXPECT_NEAR(p.readings[2].motion.y, 0, 1e-9);
}

/// As offline, readings replace the actions; those of the other frame would be jumps.
TEST(RawlogPlayer, ActionsAreNotUsedBesideOdometryReadings) {
  test::Log log;
  for (int i = 0; i < 5; ++i) {
    log.push_back(test::action({0, 0.1, 0}));
    const auto frame = test::frame({test::scan(10 + i)});
    frame->insert(test::odometry(10 + i, {5 + 0.2 * i, 3, 0}));
    log.push_back(frame);
  }
  const Played p = played(log, 5);
  ASSERT_EQ(p.readings.size(), 5u);
  for (size_t i = 1; i < p.readings.size(); ++i) {
    EXPECT_NEAR(p.readings[i].motion.x, 0.2, 1e-9);
    EXPECT_NEAR(p.readings[i].motion.y, 0, 1e-9);
  }
}

TEST(RawlogPlayer, StopsOnRequest) {
  EXPECT_EQ(played(test::laps(50), 5, 7).cycles, 7u);
  const files::TemporaryFolder folder;
  const std::string log = test::writePlain(folder.path("log"), test::laps(10));
  int asked = 0;
  EXPECT_THROW(RawlogPlayer(log, 5, kFast, [&] { return ++asked == 3; }), std::runtime_error);
  EXPECT_EQ(asked, 3);
}

TEST(RawlogPlayer, TheSlowestRateIsNotTheFastest) {
  const files::TemporaryFolder folder;
  RawlogPlayer player(test::writePlain(folder.path("log"), test::laps(10)), 5, 1e-300);
  size_t cycles = 0;
  const auto start = std::chrono::steady_clock::now();
  player.run([&](const CSensoryFrame::Ptr&) { ++cycles; },
             [&] { return std::chrono::steady_clock::now() - start > std::chrono::milliseconds(300); });
  EXPECT_EQ(cycles, 1u);
}

TEST(RawlogPlayer, ALogWithoutScansIsAnError) {
  EXPECT_THROW(played({test::odometry(1, {})}, 5), InputError);
  EXPECT_THROW(RawlogPlayer("/none.rawlog", 5, 0), InputError);
}

}  // namespace
}  // namespace hybrid_slam::live
