/// @file BagPlan.h
/// @brief Which messages of a bag give scans and odometry.
#pragma once

#include <mrpt/math/TPose3D.h>

#include <map>
#include <string>
#include <vector>

#include "bags/Bag.h"
#include "readings/FrameTree.h"

namespace hybrid_slam::readings {

/// The user's choice; empty: the default (planOf).
struct BagOptions {
  std::vector<std::string> topics;  ///< of scans
  std::string odometryTopic;        ///< of nav_msgs/Odometry, or that of the transforms
};

/// What a bag holds, from one pass.
struct BagContents {
  struct Entry {
    bags::Topic topic;
    size_t messages = 0, broken = 0;
    std::string frame;  ///< of the first message: the scan's, or the odometry's child frame
  };
  std::vector<Entry> topics;  ///< in the order in which they occur
  FrameTree frames;
  std::string defect;  ///< empty for an intact file

  /// `/scan (sensor_msgs/LaserScan, 120 messages), /odom ...`; at most 20.
  std::string list() const;
  /// A line for each topic, by name: its messages, name and type.
  std::string table() const;
};

/// @throws InputError if the file is not a bag, or damaged before its first message
BagContents contentsOf(const std::string& file);

/// A scan topic is a laser. Its pose follows from the transforms between the robot's base and the scan's
/// frame, in the first value of each: a laser does not move on the robot.
struct BagPlan {
  struct Laser {
    std::string topic;
    mrpt::math::TPose3D pose;  ///< on the robot
    bool isMountingKnown = true;
  };
  std::vector<Laser> lasers;
  std::string odometryTopic;         ///< of nav_msgs/Odometry; empty: from the transforms
  std::string odomFrame, baseFrame;  ///< the transform that is the odometry; empty: none
  std::vector<std::string> notes;    ///< for the user: what was assumed
};

/// By default all lasers are used, and the odometry is that of the only odometry topic, or else the transform
/// from an `odom` frame to the robot's base. The default needs lasers in frames of their own with known
/// poses, if there are several, and at most one odometry topic.
/// @throws InputError if there are no scans, a topic is missing, or there is no default; it lists the topics
///         and names the options
BagPlan planOf(const BagContents& contents, const BagOptions& options, const std::string& file);

}  // namespace hybrid_slam::readings
