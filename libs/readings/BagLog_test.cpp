#include "readings/BagLog.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "files/TemporaryFolder.h"
#include "readings/LogReader.h"
#include "readings/LogWarnings.h"
#include "readings/RawlogSource.h"
#include "readings/SweepTimes.h"
#include "readings/Timestamps.h"
#include "testing/ErrorOf.h"
#include "testing/TestBags.h"

namespace hybrid_slam::readings {
namespace {

using bags::Encoding;
using mrpt::math::TPose2D;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationOdometry;
using test::TestMessage;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const test::MessageBytes kCdr(Encoding::cdr);

TestMessage scanOn(const std::string& topic, double time, const std::string& frame,
                   const std::vector<float>& ranges = {1, 2, 3}, float angleMin = -1, float step = 0.5f,
                   float timeStep = 0) {
  return {topic, "sensor_msgs/LaserScan", time,
          test::scanBytes(kCdr, time, frame, ranges, angleMin, step, timeStep)};
}

TestMessage odometryAt(double time, const TPose2D& pose, const std::string& topic = "/odom",
                       const std::string& child = "base_link") {
  return {topic, "nav_msgs/Odometry", time, test::odometryBytes(kCdr, time, pose, child)};
}

TestMessage frameAt(const std::string& parent, const std::string& child, const std::vector<double>& pose,
                    double time = 1, const std::string& topic = "/tf_static") {
  return {topic, "tf2_msgs/TFMessage", time, test::transformBytes(kCdr, time, {{parent, child, pose}})};
}

class BagLogTest : public testing::Test {
 protected:
  std::string write(const std::vector<TestMessage>& messages) {
    return test::writeMcap(folder.path("log.mcap"), messages);
  }
  BagPlan plan(const std::vector<TestMessage>& messages, const BagOptions& options = {}) {
    const std::string file = write(messages);
    return planOf(contentsOf(file), options, file);
  }
  std::string errorOf(const std::vector<TestMessage>& messages, const BagOptions& options = {}) {
    return test::errorOf([&] { plan(messages, options); });
  }
  template <class Object>
  std::vector<std::shared_ptr<Object>> read(const std::vector<TestMessage>& messages) {
    LogReader reader(write(messages));
    std::vector<std::shared_ptr<Object>> all;
    while (const auto object = reader.next())
      if (auto one = std::dynamic_pointer_cast<Object>(object)) all.push_back(one);
    return all;
  }
  CObservation2DRangeScan::Ptr onlyScan(const std::vector<TestMessage>& messages) {
    const auto all = read<CObservation2DRangeScan>(messages);
    return all.size() == 1 ? all[0] : nullptr;
  }

  files::TemporaryFolder folder;
};

TEST_F(BagLogTest, TheTimeFromTheFirstBeamToTheLastIsStatedBeforeTheScans) {
  using mrpt::obs::CObservationComment;
  const auto one = [](const std::string& topic, double time, size_t beams) {
    return scanOn(topic, time, "laser", std::vector<float>(beams, 1), -1, 0.01F, 0.001F);
  };
  const auto comments =
      read<CObservationComment>({one("/scan", 1, 101), one("/scan", 2, 101), one("/scan", 3, 51)});
  ASSERT_EQ(comments.size(), 2) << "the first, and another one";
  const auto first = sweepTimeIn(*comments[0]), second = sweepTimeIn(*comments[1]);
  EXPECT_EQ(first->label, "/scan");
  EXPECT_NEAR(first->seconds, 0.1, 1e-6);
  EXPECT_NEAR(second->seconds, 0.05, 1e-6);
  EXPECT_NEAR(seconds(comments[1]->timestamp), 3, 1e-6);
}

TEST_F(BagLogTest, TheSearchForTopicsCanBeStopped) {
  const std::string file = write({scanOn("/scan", 1, "laser"), scanOn("/scan", 2, "laser")});
  int asked = 0;
  EXPECT_EQ(test::errorOf<std::runtime_error>([&] { contentsOf(file, [&] { return ++asked == 2; }); }),
            "interrupted: message 2 of " + file);
}

TEST_F(BagLogTest, AnImpossibleTimeFromBeamToBeamIsReportedAndNotUsed) {
  const std::string file = write(
      {odometryAt(0.9, {}), scanOn("/scan", 1, "laser", std::vector<float>(2000, 1), -1, 0.001F, 0.001F),
       odometryAt(1.1, {1, 0, 0}), odometryAt(4, {2, 0, 0})});
  const RawlogSummary log = summarise(file, {});
  EXPECT_EQ(log.wrongSweeps.count, 1);
  EXPECT_TRUE(log.sweeps.empty());
  EXPECT_THAT(warningsOf(log, file),
              testing::Contains(HasSubstr("1 scan time (first beam to last) below 0 or over 1 s")));
}

TEST_F(BagLogTest, WithoutOdometryAWarningSaysThatBeamsAreNotCorrected) {
  const std::string file = write({scanOn("/scan", 1, "laser", {1, 2, 3}, -1, 0.5F, 0.001F)});
  EXPECT_THAT(warningsOf(summarise(file, {}), file),
              testing::Contains(HasSubstr("without odometry the beams are not corrected")));
}

/// Beams from 0 to 1 rad: MRPT's fan is symmetric, about 0.5 rad.
TEST_F(BagLogTest, ScanOfAnyApertureHasItsBeamsWhereTheyWere) {
  const auto scan = onlyScan({scanOn("/scan", 7.25, "laser", {1, 2, 3}, 0, 0.5f)});
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->sensorLabel, "/scan");
  EXPECT_NEAR(seconds(scan->timestamp), 7.25, 1e-6);
  EXPECT_NEAR(scan->aperture, 1, 1e-6);
  EXPECT_TRUE(scan->rightToLeft);
  EXPECT_NEAR(scan->sensorPose.yaw(), 0.5, 1e-6);
  EXPECT_EQ(scan->maxRange, 20);
}

TEST_F(BagLogTest, TheFirstEchoesAreAScan) {
  const std::vector<TestMessage> messages{
      {"/echoes", "sensor_msgs/MultiEchoLaserScan", 7.25,
       test::echoesBytes(kCdr, 7.25, "base_link", {{4, 5}, {}, {6, 9}, {25}, {2}})}};
  ASSERT_EQ(plan(messages).lasers.size(), 1u);
  EXPECT_EQ(plan(messages).lasers[0].topic, "/echoes");
  const auto scan = onlyScan(messages);
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->sensorLabel, "/echoes");
  EXPECT_NEAR(seconds(scan->timestamp), 7.25, 1e-6);
  EXPECT_NEAR(scan->aperture, 2, 1e-6);
  ASSERT_EQ(scan->getScanSize(), 5u);
  EXPECT_EQ(scan->getScanRange(0), 4);
  EXPECT_EQ(scan->getScanRange(2), 6);
  std::vector<bool> valid;
  for (size_t i = 0; i < 5; ++i) valid.push_back(scan->getScanRangeValidity(i));
  EXPECT_THAT(valid, ElementsAre(true, false, true, false, true)) << "no echo; beyond the limit of 20 m";
}

TEST_F(BagLogTest, BeamsInTheOtherDirection) {
  const auto scan = onlyScan({scanOn("/scan", 1, "laser", {1, 2, 3}, 0.5f, -0.5f)});
  ASSERT_TRUE(scan);
  EXPECT_FALSE(scan->rightToLeft);
  EXPECT_NEAR(scan->aperture, 1, 1e-6);
  EXPECT_NEAR(scan->sensorPose.yaw(), 0, 1e-6);
}

TEST_F(BagLogTest, RangesOutsideTheLimitsAreNoReturns) {
  const float nan = std::nanf(""), infinite = std::numeric_limits<float>::infinity();
  const auto scan = onlyScan({scanOn("/scan", 1, "laser", {0.1f, 0.2f, 19.9f, 20, nan, infinite, -1, 0})});
  ASSERT_TRUE(scan);
  std::vector<bool> valid;
  for (size_t i = 0; i < scan->getScanSize(); ++i) valid.push_back(scan->getScanRangeValidity(i));
  EXPECT_THAT(valid, ElementsAre(false, true, true, false, false, false, false, false));
}

TEST_F(BagLogTest, MountingIsThatOfTheTransformsFromTheBaseOfTheOdometry) {
  const auto scan =
      onlyScan({frameAt("mast", "laser", test::turned(0.1, 0, M_PI / 2)),
                frameAt("base_link", "mast", test::turned(0.5, 0.2, M_PI / 2)),
                frameAt("base_footprint", "base_link", test::turned(0, 0, 0)),
                odometryAt(1, {}, "/odom", "base_footprint"), scanOn("/scan", 1, "laser", {1, 2, 3, 4, 5})});
  ASSERT_TRUE(scan);
  EXPECT_NEAR(scan->sensorPose.x(), 0.5, 1e-9);
  EXPECT_NEAR(scan->sensorPose.y(), 0.3, 1e-9);
  EXPECT_NEAR(scan->sensorPose.z(), 0.9, 1e-9);
  EXPECT_NEAR(std::abs(scan->sensorPose.yaw()), M_PI, 1e-6);
}

TEST_F(BagLogTest, ALaserUpsideDownIsOne) {
  const auto scan = onlyScan({frameAt("base_link", "laser", {0.2, 0, 0.1, 1, 0, 0, 0}),
                              scanOn("/scan", 1, "laser", {1, 2, 3}, 0, 0.5f)});
  ASSERT_TRUE(scan);
  EXPECT_NEAR(std::abs(scan->sensorPose.roll()), M_PI, 1e-9);
  EXPECT_NEAR(scan->sensorPose.yaw(), -0.5, 1e-6);  // its left is the robot's right
}

TEST_F(BagLogTest, WithoutATransformTheLaserIsAtTheCentreAndTheUserIsTold) {
  const auto messages = std::vector{odometryAt(1, {}), scanOn("/scan", 1, "laser", {1, 2, 3}, -0.5f)};
  const BagPlan found = plan(messages);
  EXPECT_THAT(found.notes, ElementsAre(HasSubstr("no transform from `base_link` to `laser`")));
  EXPECT_EQ(onlyScan(messages)->sensorPose.norm(), 0);
  const std::string file = write(messages);
  EXPECT_THAT(warningsOf(summarise(file, {}), file), testing::Contains(HasSubstr("no transform")));
}

TEST_F(BagLogTest, OdometryIsThatOfItsTopic) {
  const auto all = read<CObservationOdometry>({odometryAt(1, {1, 2, 0.5}), scanOn("/scan", 1, "base_link")});
  ASSERT_EQ(all.size(), 1u);
  EXPECT_NEAR(all[0]->odometry.x(), 1, 1e-12);
  EXPECT_NEAR(all[0]->odometry.phi(), 0.5, 1e-12);
  EXPECT_NEAR(seconds(all[0]->timestamp), 1, 1e-6);
}

TEST_F(BagLogTest, WithoutATopicOdometryIsTheTransformBelowOdom) {
  const std::vector<TestMessage> messages{
      frameAt("base", "laser", test::turned(0.25, 0, 0)), frameAt("map", "odom", test::turned(9, 9, 0)),
      frameAt("odom", "base", test::turned(1, 0, 0.1), 1, "/tf"), scanOn("/scan", 1, "laser"),
      frameAt("odom", "base", test::turned(2, 0, 0.2), 2, "/tf")};
  const auto all = read<CObservationOdometry>(messages);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_NEAR(all[1]->odometry.x(), 2, 1e-12);
  EXPECT_NEAR(all[1]->odometry.phi(), 0.2, 1e-12);
  EXPECT_NEAR(onlyScan(messages)->sensorPose.x(), 0.25, 1e-12);
  EXPECT_THAT(plan(messages).notes, IsEmpty());
}

/// A recording of /tf without /tf_static.
TEST_F(BagLogTest, TheTransformBelowOdomIsTheOdometryAlsoOfALaserWithoutATransform) {
  std::vector<TestMessage> messages{frameAt("map", "odom", test::turned(9, 9, 0)),
                                    frameAt("odom", "base_link", test::turned(1, 0, 0), 1, "/tf"),
                                    frameAt("base_link", "left_wheel", test::turned(0, 0.1, 0)),
                                    scanOn("/scan", 1, "laser"),
                                    frameAt("odom", "base_link", test::turned(2, 0, 0), 2, "/tf")};
  const auto all = read<CObservationOdometry>(messages);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_NEAR(all[1]->odometry.x(), 2, 1e-12);
  EXPECT_THAT(plan(messages).notes, ElementsAre(HasSubstr("no transform from `base_link` to `laser`")));

  messages.push_back(frameAt("second_odom", "trailer", test::turned(0, 0, 0)));
  EXPECT_THAT(plan(messages).odomFrame, IsEmpty()) << "which of them is not known";
  EXPECT_THAT(errorOf(messages, {{}, "/tf"}), HasSubstr("no odometry among the transforms"));
}

/// The scan is recorded after odometry of a later time.
TEST_F(BagLogTest, ObjectsAreInTheOrderOfTheirTimes) {
  std::vector<TestMessage> messages{odometryAt(1, {1, 0, 0}), odometryAt(1.2, {2, 0, 0}),
                                    scanOn("/scan", 1.1, "base_link"), odometryAt(5, {3, 0, 0}),
                                    scanOn("/scan", 5, "base_link")};
  LogReader reader(write(messages));
  std::string order;
  while (const auto object = reader.next())
    order += std::dynamic_pointer_cast<CObservationOdometry>(object) ? "o" : "s";
  EXPECT_EQ(order, "osoos");
}

/// The clock was an hour ahead until the time was set.
TEST_F(BagLogTest, WhereTheClockIsSetBackTheOrderOfRecordingIsKept) {
  std::vector<TestMessage> messages;
  for (int i = 0; i < 20; ++i) {
    const double time = 0.1 * i + (i < 10 ? 3601 : 1);
    messages.push_back(odometryAt(time, {0.1 * i, 0, 0}));
    messages.push_back(
        scanOn("/scan", time, "laser", std::vector<float>(3, 1 + 0.1F * static_cast<float>(i))));
  }
  const auto scans = read<CObservation2DRangeScan>(messages);
  ASSERT_EQ(scans.size(), 20u);
  for (size_t i = 0; i < scans.size(); ++i)
    EXPECT_NEAR(scans[i]->getScanRange(0), 1 + 0.1 * static_cast<double>(i), 1e-5) << i;
}

TEST_F(BagLogTest, MessagesOfAnotherTypeOnATopicAreNotUsed) {
  std::vector<TestMessage> messages{
      scanOn("/scan", 1, "laser"),  odometryAt(1, {}), scanOn("/odom", 1.1, "laser"),
      odometryAt(1.2, {}, "/scan"), odometryAt(2, {}), scanOn("/scan", 2, "laser")};
  const std::string file = write(messages);
  InputOptions options;
  options.sensorLabel = "/scan";
  const RawlogSummary log = summarise(file, options);
  EXPECT_EQ(log.scans, 2u);
  EXPECT_EQ(log.entries, 6u);
  EXPECT_EQ(read<CObservationOdometry>({messages[0], messages[1], messages[3], messages[4]}).size(), 2u);
}

// Whole seconds do not tell which odometry a scan has; the order of recording does.
TEST_F(BagLogTest, MessagesWithTheSameStampAreInTheOrderOfRecording) {
  std::vector<TestMessage> messages;
  for (int i = 0; i < 8; ++i) {
    const double time = 1 + i / 4;  // NOLINT(bugprone-integer-division)
    messages.push_back(odometryAt(time, {0.1 * i, 0, 0}));
    messages.push_back(scanOn("/scan", time, "laser"));
  }
  const std::string file = write(messages);
  RawlogSource source(file, {}, summarise(file, {}));
  size_t scans = 0;
  for (auto reading = source.next(); reading; reading = source.next(), ++scans)
    EXPECT_NEAR(reading->motion.x, scans == 0 ? 0 : 0.1, 1e-6) << scans;
  EXPECT_EQ(scans, 8u);
}

TEST_F(BagLogTest, AZeroStampIsTheTimeOfRecording) {
  TestMessage message = scanOn("/scan", 0, "base_link");
  message.time = 12.5;
  EXPECT_NEAR(seconds(onlyScan({message})->timestamp), 12.5, 1e-6);
}

TEST_F(BagLogTest, BrokenMessagesAreCountedAndSkipped) {
  std::vector<TestMessage> messages{scanOn("/scan", 1, "base_link"), scanOn("/scan", 2, "base_link")};
  messages.insert(messages.begin() + 1, {"/scan", "sensor_msgs/LaserScan", 1.5, "nonsense"});
  const std::string file = write(messages);
  const RawlogSummary summary = summarise(file, {});
  EXPECT_EQ(summary.scans, 2u);
  EXPECT_EQ(summary.brokenLines.count, 1u);
  EXPECT_EQ(summary.brokenLines.first, 2u);
  EXPECT_THAT(warningsOf(summary, file),
              testing::Contains(HasSubstr("1 broken message: first at message 2 of ")));
}

TEST_F(BagLogTest, ACutBagIsReadUpToTheCut) {
  std::vector<TestMessage> messages;
  for (int i = 0; i < 100; ++i) messages.push_back(scanOn("/scan", i, "base_link"));
  const std::string file = write(messages);
  const std::string bytes = test::contentOf(file);
  test::write(file, bytes.substr(0, bytes.size() / 2));
  const RawlogSummary summary = summarise(file, {});
  EXPECT_GT(summary.scans, 10u);
  EXPECT_LT(summary.scans, 90u);
  EXPECT_THAT(summary.defect, HasSubstr("cut off"));
  EXPECT_EQ(summary.unit, "message");
}

TEST_F(BagLogTest, SeveralLasersWithPosesAreAllUsed) {
  const std::vector<TestMessage> messages{frameAt("base_link", "front", test::turned(0.3, 0, 0)),
                                          frameAt("base_link", "rear", test::turned(-0.3, 0, M_PI)),
                                          scanOn("/scan_front", 1, "front"), scanOn("/scan_rear", 1, "rear"),
                                          odometryAt(1, {})};
  const BagPlan all = plan(messages);
  ASSERT_EQ(all.lasers.size(), 2u);
  EXPECT_EQ(all.lasers[1].topic, "/scan_rear");
  EXPECT_NEAR(all.lasers[1].pose.x, -0.3, 1e-12);
  EXPECT_THAT(all.notes, IsEmpty());
  EXPECT_THAT(plan(messages, {{"/scan_front", "/scan_rear"}, ""}).notes, IsEmpty());
  EXPECT_EQ(plan(messages, {{"/scan_rear"}, ""}).lasers.size(), 1u);
  InputOptions options;
  options.sensorLabel = "/scan_rear";
  const std::string file = write(messages);
  const RawlogSummary summary = summarise(file, options);
  EXPECT_THAT(summary.lasers, ElementsAre("/scan_rear"));
  EXPECT_THAT(warningsOf(summary, file),
              ElementsAre("laser `/scan_front` is not used: not in --topic or [input] sensor_label"));
}

TEST_F(BagLogTest, ALaserWhoseMessagesAreAllBrokenIsNotUsedAndTheUserIsTold) {
  const std::vector<TestMessage> messages{{"/broken", "sensor_msgs/LaserScan", 0.5, "nonsense"},
                                          scanOn("/scan", 1, "base_link"),
                                          odometryAt(1, {})};
  const BagPlan found = plan(messages);
  ASSERT_EQ(found.lasers.size(), 1u);
  EXPECT_THAT(found.notes, ElementsAre("laser `/broken` is not used: all its messages are broken"));
}

TEST_F(BagLogTest, ScansThatAreAllBrokenAreAnErrorThatSaysWhy) {
  const auto errorWith = [this](const std::string& bytes) {
    return errorOf({{"/scan", "sensor_msgs/LaserScan", 0.5, bytes}});
  };
  EXPECT_THAT(errorWith("nonsense"), HasSubstr("all messages of /scan are broken: "));
  EXPECT_THAT(errorWith("\x28\xb5\x2f\xfd etc."), HasSubstr("broken: each is compressed"));
}

TEST_F(BagLogTest, ALaserFrameWithTwoParentsIsReported) {
  const BagPlan found = plan({frameAt("mast", "laser", test::turned(5, 0, 0)),
                              frameAt("base_link", "laser", test::turned(0.2, 0, 0)),
                              frameAt("base_link", "mast", test::turned(0, 0, 0)),
                              scanOn("/scan", 1, "laser"), odometryAt(1, {})});
  EXPECT_THAT(found.notes, ElementsAre("the transforms to the laser of /scan have several parents: frame "
                                       "`laser`; the first is used"));
}

TEST_F(BagLogTest, WhatIsNotClearIsAnErrorThatListsTheTopics) {
  const TestMessage scan = scanOn("/scan", 1, "laser");
  EXPECT_THAT(errorOf({odometryAt(1, {})}), HasSubstr("no laser scans: "));
  EXPECT_THAT(errorOf({odometryAt(1, {})}),
              HasSubstr("the bag has /odom (nav_msgs/msg/Odometry, 1 messages)"));
  const std::vector<TestMessage> twins{scan, scanOn("/scan_filtered", 1, "laser"),
                                       frameAt("base_link", "laser", test::turned(0, 0, 0))};
  EXPECT_THAT(errorOf(twins),
              HasSubstr("choose with --topic or [input] sensor_label: /scan (sensor_msgs/msg/LaserScan"));
  EXPECT_EQ(errorOf(twins, {{"/scan"}, ""}), "no error");
  EXPECT_THAT(errorOf(twins, {{"/laser"}, ""}), HasSubstr("no scans on the topic `/laser`"));
  const std::vector<TestMessage> unknown{scan, scanOn("/other", 1, "elsewhere")};
  EXPECT_THAT(errorOf(unknown), HasSubstr("several scan topics"));
  EXPECT_THAT(errorOf(unknown, {{"/scan", "/other"}, ""}),
              HasSubstr("no transform from `base_link` to `laser`"));
  const std::vector<TestMessage> odometries{scan, odometryAt(1, {}), odometryAt(1, {}, "/filtered")};
  EXPECT_THAT(errorOf(odometries), HasSubstr("several odometry topics"));
  EXPECT_THAT(errorOf(odometries), HasSubstr("--odometry-topic or [input] odometry_topic: /odom"));
  EXPECT_EQ(plan(odometries, {{}, "/filtered"}).odometryTopic, "/filtered");
  EXPECT_THAT(errorOf(odometries, {{}, "/none"}), HasSubstr("no odometry on the topic `/none`"));
}

TEST_F(BagLogTest, TransformsThatGoInACircleEnd) {
  EXPECT_EQ(errorOf({frameAt("a", "b", test::turned(0, 0, 0)), frameAt("b", "a", test::turned(0, 0, 0)),
                     scanOn("/scan", 1, "a")}),
            "no error");
}

}  // namespace
}  // namespace hybrid_slam::readings
