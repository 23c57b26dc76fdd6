/// @file RosBags.h
/// @brief For the tests: ROS 1 bags, written by ROS's own library.
#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <rosbag/bag.h>

#include <cstring>
#include <string>
#include <vector>

#include "testing/TestBags.h"

/// Traits that make ROS's library accept a class as a message.
namespace ros {
namespace message_traits {
template <>
struct MD5Sum<hybrid_slam::test::TestMessage> {
  static const char* value(const hybrid_slam::test::TestMessage&) {
    return "00000000000000000000000000000000";
  }
};
template <>
struct DataType<hybrid_slam::test::TestMessage> {
  static const char* value(const hybrid_slam::test::TestMessage& m) { return m.type.c_str(); }
};
template <>
struct Definition<hybrid_slam::test::TestMessage> {
  static const char* value(const hybrid_slam::test::TestMessage&) { return "a definition"; }
};
}  // namespace message_traits
namespace serialization {
template <>
struct Serializer<hybrid_slam::test::TestMessage> {
  template <class Stream>
  static void write(Stream& stream, const hybrid_slam::test::TestMessage& m) {
    std::memcpy(stream.advance(static_cast<uint32_t>(m.bytes.size())), m.bytes.data(), m.bytes.size());
  }
  static uint32_t serializedLength(const hybrid_slam::test::TestMessage& m) {
    return static_cast<uint32_t>(m.bytes.size());
  }
};
}  // namespace serialization
}  // namespace ros

namespace hybrid_slam::test {

inline std::string writeRosBag(const std::string& path, const std::vector<TestMessage>& messages,
                               rosbag::CompressionType compression = rosbag::compression::Uncompressed) {
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  bag.setCompression(compression);
  bag.setChunkThreshold(20000);
  for (const TestMessage& message : messages) bag.write(message.topic, ros::Time(message.time), message);
  bag.close();
  return path;
}

}  // namespace hybrid_slam::test
