#include "readings/SweepTimes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "testing/TestLogs.h"

namespace hybrid_slam::readings {
namespace {

std::optional<SweepTime> read(const std::string& text) {
  mrpt::obs::CObservationComment comment;
  comment.text = text;
  return sweepTimeIn(comment);
}

TEST(SweepTimes, AreWrittenAndReadBack) {
  for (const std::string label : {"LASER", "/front laser, scan", ""}) {
    const auto comment = commentOf({label, 0.1 / 3}, test::stamp(5));
    EXPECT_EQ(comment->timestamp, test::stamp(5));
    const auto sweep = sweepTimeIn(*comment);
    ASSERT_TRUE(sweep);
    EXPECT_EQ(sweep->label, label);
    EXPECT_EQ(sweep->seconds, 0.1 / 3);
  }
  EXPECT_EQ(commentOf({"LASER", 0.075}, {})->text, "scan_time = 0.075 s, laser LASER");
}

TEST(SweepTimes, OtherObservationsAreNone) {
  EXPECT_FALSE(sweepTimeIn(*test::scan(1)));
  EXPECT_FALSE(read(""));
  EXPECT_FALSE(read("scan_time = 0.1"));
  EXPECT_FALSE(read("the scan_time = 0.1 s, laser LASER"));
  EXPECT_FALSE(read("scan_time = 0.1 s, laser " + std::string(1001, 'x')));
  EXPECT_TRUE(std::isnan(read("scan_time = fast s, laser LASER")->seconds));
}

TEST(SweepTimes, HoldForTheScansOfTheirLaser) {
  SweepTimes times;
  EXPECT_EQ(times.of(*test::scan(1)), 0);
  times.take({"LASER", 0.1});
  EXPECT_EQ(times.of(*test::scan(1)), 0.1);
  EXPECT_EQ(times.of(*test::scan(1, {}, 181, "REAR")), 0);
  EXPECT_EQ(times.of(*test::scan(test::kNoTime)), 0) << "without timestamp";
  EXPECT_EQ(times.of(*test::scan(1, {}, 1)), 0) << "one beam";
  times.take({"LASER", 0.2});
  EXPECT_EQ(times.of(*test::scan(1)), 0.2);
}

TEST(SweepTimes, ThoseThatCannotBeAreNotKnown) {
  for (const double seconds : {-0.1, 1.01, 1e9, std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    SweepTimes times;
    times.take({"LASER", 0.1});
    times.take({"LASER", seconds});
    EXPECT_FALSE(isSweepTime(seconds));
    EXPECT_EQ(times.of(*test::scan(1)), 0) << seconds;
  }
}

TEST(SweepTimes, ASettingReplacesThoseOfTheLog) {
  SweepTimes fixed(0.05), off(0);
  fixed.take({"LASER", 0.1}), off.take({"LASER", 0.1});
  EXPECT_EQ(fixed.of(*test::scan(1)), 0.05);
  EXPECT_EQ(off.of(*test::scan(1)), 0);
}

TEST(SweepTimes, ARateGivesEachLaserTheTimeOfItsAperture) {
  SweepTimes times(SweepSetting{std::nullopt, 10.0});
  times.take({"LASER", 0.2});
  const auto front = test::scan(1), rear = test::scan(1, {}, 271, "REAR");
  rear->aperture = static_cast<float>(1.5 * M_PI);
  EXPECT_NEAR(times.of(*front), 0.05, 1e-8) << "180 of 360 deg";
  EXPECT_NEAR(times.of(*rear), 0.075, 1e-8) << "270 of 360 deg";
  EXPECT_EQ(times.of(*test::scan(test::kNoTime)), 0) << "without timestamp";
  EXPECT_EQ(times.of(*test::scan(1, {}, 1)), 0) << "one beam";
  for (const float aperture : {-1.F, 100.F, 1e30F, NAN}) {
    rear->aperture = aperture;
    EXPECT_EQ(times.of(*rear), 0) << aperture;
  }
}

TEST(SweepTimes, ASettingIsATimeOrARateOrNone) {
  EXPECT_FALSE(SweepSetting().of(M_PI));
  EXPECT_EQ((SweepSetting{0.02, std::nullopt}.of(M_PI)), 0.02);
  EXPECT_EQ((SweepSetting{0.0, std::nullopt}.of(M_PI)), 0.0) << "off, whatever the log states";
  EXPECT_EQ((SweepSetting{std::nullopt, 25.0}.of(M_PI)), 0.02);
}

}  // namespace
}  // namespace hybrid_slam::readings
