#include "live/CycleGrouper.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "testing/TestLogs.h"

namespace hybrid_slam::live {
namespace {

using test::odometry;
using test::scan;
using testing::ElementsAre;

/// Records each cycle as text: o for odometry, s for a scan, with the times.
struct Cycles {
  std::vector<std::string> texts;
  CycleGrouper grouper;

  explicit Cycles(double rate)
      : grouper(rate, [this](const mrpt::obs::CSensoryFrame::Ptr& cycle) { note(*cycle); }) {}
  void note(const mrpt::obs::CSensoryFrame& cycle) {
    std::string text;
    for (const auto& observation : cycle) {
      char each[32];
      const bool isScan =
          static_cast<bool>(std::dynamic_pointer_cast<mrpt::obs::CObservation2DRangeScan>(observation));
      const bool isStamped = observation->timestamp != INVALID_TIMESTAMP;
      std::snprintf(each, sizeof each, "%s%s%.2f", text.empty() ? "" : " ", isScan ? "s" : "o",
                    isStamped ? mrpt::Clock::toDouble(observation->timestamp) : -1);
      text += each;
    }
    texts.push_back(text);
  }
  void odo(double time) { grouper.add(test::odometry(time, {})); }
  void laser(double time, const std::string& label = "LASER") { grouper.add(scan(time, {}, 3, label)); }
};

TEST(CycleGrouper, StampsThatDoNotAdvanceFillNoMemory) {
  size_t most = 0, all = 0;
  CycleGrouper grouper(5, [&](const mrpt::obs::CSensoryFrame::Ptr& cycle) {
    most = std::max(most, cycle->size());
    all += cycle->size();
  });
  for (int i = 0; i < 100000; ++i) grouper.add(odometry(10, {}));
  EXPECT_EQ(all, 100000u);
  EXPECT_LE(most, kMostWaiting);
}

TEST(CycleGrouper, LargeScansFillNoMemory) {
  size_t most = 0, all = 0;
  CycleGrouper grouper(5, [&](const mrpt::obs::CSensoryFrame::Ptr& cycle) {
    most = std::max(most, cycle->size());
    all += cycle->size();
  });
  grouper.add(odometry(9.9, {}));
  for (int i = 0; i < 10; ++i) {
    const auto large = scan(10, {}, 3, "LASER" + std::to_string(i));
    large->resizeScan(1 << 20);
    grouper.add(large);
  }
  grouper.finish();
  EXPECT_LE(most, 4u);
  EXPECT_EQ(all, 11u);
}

TEST(CycleGrouper, LabelsWithoutEndFillNoMemory) {
  size_t all = 0;
  CycleGrouper grouper(5, [&](const mrpt::obs::CSensoryFrame::Ptr& cycle) { all += cycle->size(); });
  for (size_t i = 0; i < 2 * kMostLasers; ++i)
    grouper.add(scan(10 + static_cast<double>(i), {}, 3, "LASER" + std::to_string(i)));
  grouper.add(scan(1000, {}, 3, "LASER0"));
  grouper.finish();
  EXPECT_EQ(all, kMostLasers + 1);
}

TEST(CycleGrouper, ACycleEndsWithTheFirstOdometryAfterItsScan) {
  Cycles c(5);
  c.odo(10.03), c.laser(10.1);
  EXPECT_THAT(c.texts, ElementsAre());
  c.odo(10.13);
  EXPECT_THAT(c.texts, ElementsAre("o10.03 s10.10 o10.13"));
  c.odo(10.23), c.laser(10.3), c.odo(10.33), c.odo(10.43);
  EXPECT_EQ(c.texts.back(), "o10.23 s10.30 o10.33");
  c.grouper.finish();
  EXPECT_EQ(c.texts.back(), "o10.43");
  EXPECT_EQ(c.texts.size(), 3u);
}

TEST(CycleGrouper, OdometryAtTheScansTimeClosesTheCycle) {
  Cycles c(5);
  c.odo(10), c.laser(10);
  c.odo(10.2), c.laser(10.2);
  EXPECT_THAT(c.texts, ElementsAre("o10.00 s10.00", "o10.20 s10.20"));
}

TEST(CycleGrouper, ALateScanIsSortedIn) {
  Cycles c(5);
  c.odo(10.0), c.odo(10.1), c.odo(10.2), c.laser(10.15);
  EXPECT_THAT(c.texts, ElementsAre("o10.00 o10.10 s10.15 o10.20"));
}

TEST(CycleGrouper, FastScansAreThinnedOutPerLaser) {
  Cycles c(5);
  for (int i = 0; i < 100; ++i) {  // 25 Hz for 4 s
    c.odo(10 + 0.04 * i), c.laser(10 + 0.04 * i);
    c.laser(10 + 0.04 * i, "REAR");
  }
  size_t scans = 0;
  for (const auto& text : c.texts) scans += static_cast<size_t>(std::count(text.begin(), text.end(), 's'));
  EXPECT_NEAR(static_cast<double>(scans), 40, 2);
}

TEST(CycleGrouper, JitterCostsNoScanAtTheCyclesOwnRate) {
  Cycles c(5);
  for (int i = 0; i < 3000; ++i) {  // 10 minutes
    const double time = 10 + 0.2 * i + (i % 3 - 1) * 0.045;
    c.odo(time - 0.01), c.laser(time), c.odo(time + 0.01);
  }
  size_t scans = 0;
  for (const auto& text : c.texts) scans += static_cast<size_t>(std::count(text.begin(), text.end(), 's'));
  EXPECT_EQ(scans, 3000u);
}

TEST(CycleGrouper, WithoutARateEveryScanIsACycle) {
  Cycles c(0);
  for (int i = 0; i < 5; ++i) c.odo(10 + 0.01 * i), c.laser(10 + 0.01 * i);
  EXPECT_EQ(c.texts.size(), 5u);
}

TEST(CycleGrouper, WithoutARateNoScanIsLeftOut) {
  Cycles c(0);
  for (const double time : {10.0, 10.1, 9.95, 10.2, 9.7, 10.3}) c.laser(time);
  c.grouper.finish();
  EXPECT_EQ(c.texts.size(), 6u);
}

/// The clocks of odometry and laser differ by 2 s.
TEST(CycleGrouper, FastScansOfASlowClockAreThinnedOut) {
  Cycles c(1);
  size_t scans = 0;
  for (int i = 0; i < 100; ++i) c.odo(12 + 0.1 * i), c.laser(10 + 0.1 * i);
  c.grouper.finish();
  for (const std::string& text : c.texts)
    scans += static_cast<size_t>(std::count(text.begin(), text.end(), 's'));
  EXPECT_NEAR(static_cast<double>(scans), 10, 1);
}

TEST(CycleGrouper, WithoutOdometryScansDoNotWait) {
  Cycles c(5);
  c.laser(10), c.laser(10.2);
  EXPECT_THAT(c.texts, ElementsAre("s10.00", "s10.20"));
  c.odo(10.3), c.laser(10.4), c.laser(10.6);
  EXPECT_EQ(c.texts.size(), 2u) << "odometry may come";
  c.laser(11.0), c.laser(11.5);
  EXPECT_EQ(c.texts.back(), "o10.30 s10.40 s10.60 s11.00 s11.50") << "the odometry has ended";
}

TEST(CycleGrouper, OdometryAloneIsDeliveredEverySecond) {
  Cycles c(5);
  for (int i = 0; i <= 30; ++i) c.odo(10 + 0.1 * i);
  c.grouper.finish();
  EXPECT_GE(c.texts.size(), 2u);
  EXPECT_LE(c.texts.size(), 4u);
}

TEST(CycleGrouper, AClockThatIsSetBackStartsANewCycle) {
  Cycles c(5);
  c.odo(1000), c.laser(1000);
  c.odo(10), c.laser(10), c.odo(10.2), c.laser(10.2);
  EXPECT_THAT(c.texts, ElementsAre("o1000.00 s1000.00", "o10.00 s10.00", "o10.20 s10.20"));
}

TEST(CycleGrouper, ObservationsWithoutTimeKeepTheirOrder) {
  Cycles c(0);
  c.odo(10), c.odo(test::kNoTime), c.laser(test::kNoTime), c.odo(10.1);
  c.grouper.finish();
  EXPECT_THAT(c.texts.front(), "o10.00 o-1.00 s-1.00");
}

}  // namespace
}  // namespace hybrid_slam::live
