#include "bags/Messages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/serialization.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/MultiEchoLaserScan.h>
#include <tf2_msgs/TFMessage.h>

#include "bags/ByteCursor.h"
#include "testing/TestBags.h"

namespace hybrid_slam::bags {
namespace {

using test::MessageBytes;
using testing::ElementsAre;

const std::vector<MessageBytes> kEncoders = {MessageBytes(Encoding::ros1), MessageBytes(Encoding::cdr),
                                             MessageBytes(Encoding::cdr, true)};

Encoding encodingOf(const MessageBytes& encoder) {
  return encoder.bytes().empty() ? Encoding::ros1 : Encoding::cdr;
}

template <class Content>
Content decode(MessageType type, Encoding encoding, const std::string& bytes) {
  return std::get<Content>(decodeMessage(type, encoding, bytes));
}

/// Serialises with the code that ROS generates from the definitions.
template <class Message>
std::string bytesOfRos(const Message& message) {
  std::string bytes(ros::serialization::serializationLength(message), '\0');
  ros::serialization::OStream stream(reinterpret_cast<uint8_t*>(bytes.data()),
                                     static_cast<uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return bytes;
}

TEST(Messages, ScanOfRos1) {
  sensor_msgs::LaserScan ros;
  ros.header.seq = 3;
  ros.header.stamp = ros::Time(1234, 500000000);
  ros.header.frame_id = "/laser";
  ros.angle_min = -1.5f;
  ros.angle_max = 1.5f;
  ros.angle_increment = 1.5f;
  ros.time_increment = 0.25f;
  ros.range_min = 0.1f;
  ros.range_max = 30;
  ros.ranges = {1, 2, 3};
  ros.intensities = {7, 8, 9};
  const auto scan = decode<ScanMessage>(MessageType::laserScan, Encoding::ros1, bytesOfRos(ros));
  EXPECT_EQ(scan.header.time, 1234.5);
  EXPECT_EQ(scan.header.frame, "laser");
  EXPECT_EQ(scan.angleMin, -1.5);
  EXPECT_EQ(scan.angleStep, 1.5);
  EXPECT_EQ(scan.timeStep, 0.25);
  EXPECT_FLOAT_EQ(static_cast<float>(scan.rangeMin), 0.1f);
  EXPECT_EQ(scan.rangeMax, 30);
  EXPECT_THAT(scan.ranges, ElementsAre(1, 2, 3));
}

TEST(Messages, FirstEchoesOfRos1) {
  sensor_msgs::MultiEchoLaserScan ros;
  ros.angle_increment = 0.5f;
  ros.ranges.resize(3);
  ros.ranges[0].echoes = {4, 5};
  ros.ranges[2].echoes = {6};
  ros.intensities.resize(1);
  ros.intensities[0].echoes = {1, 2};
  const auto scan = decode<ScanMessage>(MessageType::multiEchoLaserScan, Encoding::ros1, bytesOfRos(ros));
  EXPECT_THAT(scan.ranges, ElementsAre(4, testing::IsNan(), 6));
}

TEST(Messages, FirstEchoesInEveryEncoding) {
  for (const MessageBytes& encoder : kEncoders) {
    const auto scan =
        decode<ScanMessage>(MessageType::multiEchoLaserScan, encodingOf(encoder),
                            test::echoesBytes(encoder, 12.25, "laser", {{4, 5}, {}, {6}}, -0.5f, 0.25f));
    EXPECT_EQ(scan.header.time, 12.25);
    EXPECT_EQ(scan.header.frame, "laser");
    EXPECT_EQ(scan.angleMin, -0.5);
    EXPECT_EQ(scan.angleStep, 0.25);
    EXPECT_EQ(scan.rangeMax, 20);
    EXPECT_THAT(scan.ranges, ElementsAre(4, testing::IsNan(), 6));
  }
}

TEST(Messages, OdometryOfRos1) {
  nav_msgs::Odometry ros;
  ros.header.seq = 3;
  ros.header.stamp = ros::Time(12, 250000000);
  ros.header.frame_id = "/odom";
  ros.child_frame_id = "/base_link";
  ros.pose.pose.position.x = 1;
  ros.pose.pose.position.y = -2;
  ros.pose.pose.position.z = 0.25;
  ros.pose.pose.orientation.x = 0.5;
  ros.pose.pose.orientation.y = -0.5;
  ros.pose.pose.orientation.z = 0.5;
  ros.pose.pose.orientation.w = -0.5;
  ros.pose.covariance[35] = 7;
  ros.twist.twist.linear.x = 8;
  ros.twist.covariance[35] = 9;
  const auto odometry = decode<OdometryMessage>(MessageType::odometry, Encoding::ros1, bytesOfRos(ros));
  EXPECT_EQ(odometry.header.time, 12.25);
  EXPECT_EQ(odometry.header.frame, "odom");
  EXPECT_EQ(odometry.childFrame, "base_link");
  EXPECT_EQ(odometry.pose.x, 1);
  EXPECT_EQ(odometry.pose.y, -2);
  EXPECT_EQ(odometry.pose.z, 0.25);
  EXPECT_EQ(odometry.pose.qx, 0.5);
  EXPECT_EQ(odometry.pose.qy, -0.5);
  EXPECT_EQ(odometry.pose.qz, 0.5);
  EXPECT_EQ(odometry.pose.qw, -0.5);
}

TEST(Messages, TransformsOfRos1) {
  tf2_msgs::TFMessage ros;
  ros.transforms.resize(2);
  ros.transforms[0].header.frame_id = "base";
  ros.transforms[0].child_frame_id = "laser";
  ros.transforms[0].transform.translation.x = 0.5;
  ros.transforms[0].transform.rotation.w = 1;  // the second has no rotation
  const auto all =
      decode<std::vector<TransformMessage>>(MessageType::transforms, Encoding::ros1, bytesOfRos(ros));
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].header.frame, "base");
  EXPECT_EQ(all[0].childFrame, "laser");
  EXPECT_EQ(all[0].pose.x, 0.5);
}

/// Not a recording: composed by hand, from the definition of sensor_msgs/msg/LaserScan and the rules of CDR.
TEST(Messages, ScanOfCdrByHand) {
  const unsigned char kBytes[] = {
      0, 1, 0,    0,                                                                // little-endian CDR
      2, 0, 0,    0,    0,   0xca, 0x9a, 0x1d,                                      // 2 s
      4, 0, 0,    0,    'o', 'd',  'o',  0,                                         // frame
      0, 0, 0x80, 0xbf, 0,   0,    0x80, 0x3f, 0, 0, 0x80, 0x3f,                    // -1, 1, 1
      0, 0, 0,    0,    0,   0,    0,    0,    0, 0, 0,    0,    0, 0, 0x20, 0x41,  // 0, 0, 0, 10
      3, 0, 0,    0,    0,   0,    0x80, 0x3f, 0, 0, 0,    0x40, 0, 0, 0xc0, 0x7f,  // 1, 2, NaN
      0, 0, 0,    0};
  const auto scan = decode<ScanMessage>(MessageType::laserScan, Encoding::cdr,
                                        {reinterpret_cast<const char*>(kBytes), sizeof kBytes});
  EXPECT_NEAR(scan.header.time, 2 + 1e-9 * 0x1d9aca00, 1e-12);
  EXPECT_EQ(scan.header.frame, "odo");
  EXPECT_EQ(scan.angleMin, -1);
  EXPECT_EQ(scan.rangeMax, 10);
  EXPECT_THAT(scan.ranges, ElementsAre(1, 2, testing::IsNan()));
}

/// Not a recording either. Doubles are aligned to 8 bytes, counted after the four that name the byte order.
/// In ROS's own messages the unused bytes between are not always 0.
TEST(Messages, TransformsOfCdrByHand) {
  const unsigned char kBytes[] = {
      0, 1, 0, 0,                                             // little-endian CDR
      1, 0, 0, 0, 2,   0,   0,    0,    0, 0,    0,    0,     // one transform, at 2 s
      5, 0, 0, 0, 'o', 'd', 'o',  'm',  0, 0x5f, 0x72, 0x6f,  // parent, 3 bytes unused
      2, 0, 0, 0, 'b', 0,   0x36, 0x38,                       // child, 2 bytes unused
      0, 0, 0, 0, 0,   0,   0xf0, 0x3f, 0, 0,    0,    0,    0, 0, 0, 0xc0,
      0, 0, 0, 0, 0,   0,   0,    0,                                       // 1, -2, 0
      0, 0, 0, 0, 0,   0,   0,    0,    0, 0,    0,    0,    0, 0, 0, 0,   // x and y of the quaternion
      0, 0, 0, 0, 0,   0,   0xf0, 0x3f, 0, 0,    0,    0,    0, 0, 0, 0};  // its z and w: 1, 0
  const auto all = decode<std::vector<TransformMessage>>(
      MessageType::transforms, Encoding::cdr, {reinterpret_cast<const char*>(kBytes), sizeof kBytes});
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].header.time, 2);
  EXPECT_EQ(all[0].header.frame, "odom");
  EXPECT_EQ(all[0].childFrame, "b");
  EXPECT_EQ(all[0].pose.x, 1);
  EXPECT_EQ(all[0].pose.y, -2);
  EXPECT_EQ(all[0].pose.qz, 1);
  EXPECT_EQ(all[0].pose.qw, 0);
}

TEST(Messages, OdometryAndTransformsInEveryEncoding) {
  for (const MessageBytes& encoder : kEncoders) {
    const Encoding encoding = encodingOf(encoder);
    const auto odometry = decode<OdometryMessage>(MessageType::odometry, encoding,
                                                  test::odometryBytes(encoder, 12.25, {1, -2, 0.5}, "basis"));
    EXPECT_EQ(odometry.header.time, 12.25);
    EXPECT_EQ(odometry.childFrame, "basis");
    EXPECT_EQ(odometry.pose.y, -2);
    EXPECT_NEAR(odometry.pose.qz, std::sin(0.25), 1e-15);
    const auto transforms = decode<std::vector<TransformMessage>>(
        MessageType::transforms, encoding,
        test::transformBytes(encoder, 5,
                             {{"a", "bc", test::turned(1, 2, 3)}, {"bc", "d", test::turned(4, 5, 6)}}));
    ASSERT_EQ(transforms.size(), 2u);
    EXPECT_EQ(transforms[1].childFrame, "d");
    EXPECT_EQ(transforms[1].pose.y, 5);
  }
}

TEST(Messages, EveryCutIsAnErrorAndSoIsWhatFollows) {
  for (const MessageBytes& encoder : kEncoders) {
    const std::pair<MessageType, std::string> all[] = {
        {MessageType::laserScan, test::scanBytes(encoder, 1, "laser", {1, 2, 3})},
        {MessageType::multiEchoLaserScan, test::echoesBytes(encoder, 1, "laser", {{1, 2}, {}, {3}})},
        {MessageType::odometry, test::odometryBytes(encoder, 1, {})},
        {MessageType::transforms, test::transformBytes(encoder, 1, {{"a", "b", test::turned(1, 2, 3)}})}};
    for (const auto& [type, bytes] : all) {
      const Encoding encoding = encodingOf(encoder);
      EXPECT_NO_THROW(decodeMessage(type, encoding, bytes));
      for (size_t kept = 0; kept < bytes.size(); ++kept)
        EXPECT_THROW(decodeMessage(type, encoding, bytes.substr(0, kept)), BrokenBytes) << kept;
      EXPECT_THROW(decodeMessage(type, encoding, bytes + std::string(8, '\0')), BrokenBytes);
    }
  }
}

TEST(Messages, ValuesThatNoMessageHas) {
  const MessageBytes encoder(Encoding::ros1);
  const auto isBroken = [](MessageType type, const std::string& bytes) {
    try {
      decodeMessage(type, Encoding::ros1, bytes);
    } catch (const BrokenBytes&) {
      return true;
    }
    return false;
  };
  EXPECT_TRUE(isBroken(MessageType::laserScan, test::scanBytes(encoder, 1, "a", {1, 2}, NAN)));
  EXPECT_TRUE(isBroken(MessageType::laserScan, test::scanBytes(encoder, 1, "a", {1, 2}, 0, 0)));
  EXPECT_TRUE(isBroken(MessageType::laserScan, test::scanBytes(encoder, 1, "a", {1, 2}, 0, 4)));
  EXPECT_FALSE(isBroken(MessageType::laserScan, test::scanBytes(encoder, 1, "a", {1}, 0, 0)));
  EXPECT_TRUE(isBroken(MessageType::laserScan, test::scanBytes(encoder, 1, std::string(300, 'a'), {1, 2})));
  EXPECT_TRUE(isBroken(MessageType::odometry, test::odometryBytes(encoder, 1, {NAN, 0, 0})));
  EXPECT_TRUE(isBroken(MessageType::laserScan, std::string(kMostMessageBytes + 1, '\0')));
  EXPECT_THROW(decodeMessage(MessageType::laserScan, Encoding::cdr, std::string("\0\3\0\0", 4)), BrokenBytes);
}

TEST(Messages, TypesOfBothVersions) {
  EXPECT_EQ(messageTypeOf("sensor_msgs/LaserScan"), MessageType::laserScan);
  EXPECT_EQ(messageTypeOf("sensor_msgs/msg/LaserScan"), MessageType::laserScan);
  EXPECT_EQ(messageTypeOf("sensor_msgs/msg/MultiEchoLaserScan"), MessageType::multiEchoLaserScan);
  EXPECT_EQ(messageTypeOf("nav_msgs/msg/Odometry"), MessageType::odometry);
  EXPECT_EQ(messageTypeOf("tf/tfMessage"), MessageType::transforms);
  EXPECT_EQ(messageTypeOf("tf2_msgs/msg/TFMessage"), MessageType::transforms);
  EXPECT_EQ(messageTypeOf("sensor_msgs/msg/LaserScan (json)"), std::nullopt);
}

}  // namespace
}  // namespace hybrid_slam::bags
