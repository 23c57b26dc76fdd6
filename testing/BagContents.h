/// @file BagContents.h
/// @brief For the tests of bags: messages to write, and what is read of them.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bags/Bag.h"
#include "testing/ErrorOf.h"
#include "testing/TestBags.h"

namespace hybrid_slam::test {

/// Twice `count` messages: scans and odometry, four of each per second.
inline std::vector<TestMessage> messages(size_t count, bags::Encoding encoding = bags::Encoding::ros1) {
  const MessageBytes empty(encoding);
  std::vector<TestMessage> all;
  for (size_t i = 0; i < count; ++i) {
    const double time = 100 + 0.25 * static_cast<double>(i);
    all.push_back({"/scan", "sensor_msgs/LaserScan", time,
                   scanBytes(empty, time, "laser", std::vector<float>(200, static_cast<float>(i)))});
    all.push_back({"/odom", "nav_msgs/Odometry", time, odometryBytes(empty, time, {time, 0, 0})});
  }
  return all;
}

/// What a bag gives.
struct Content {
  std::vector<TestMessage> messages;
  std::string defect;
};

inline Content read(const std::string& path) {
  const auto bag = bags::openBag(path);
  Content content;
  while (const auto message = bag->next()) {
    const bags::Topic& topic = bag->topics()[message->topic];
    content.messages.push_back({topic.name, topic.type, message->time, std::string(message->bytes)});
  }
  EXPECT_FALSE(bag->next());
  content.defect = bag->defect();
  return content;
}

inline void expectSame(const std::vector<TestMessage>& found, const std::vector<TestMessage>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].topic, expected[i].topic);
    EXPECT_EQ(bags::messageTypeOf(found[i].type), bags::messageTypeOf(expected[i].type));
    EXPECT_NEAR(found[i].time, expected[i].time, 1e-6);
    EXPECT_EQ(found[i].bytes, expected[i].bytes);
  }
}

/// The message of the error that reading the bag throws.
inline std::string errorOfBag(const std::string& path) {
  return errorOf([&] { read(path); });
}

}  // namespace hybrid_slam::test
