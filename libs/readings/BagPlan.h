/// @file BagPlan.h
/// @brief Chooses the topics of a bag that give scans and odometry.
#pragma once

#include <mrpt/math/TPose3D.h>

#include <functional>
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

/// Contents of a bag, from one pass.
struct BagContents {
  /// A topic and what was found in it.
  struct Entry {
    bags::Topic topic;
    size_t messages = 0, broken = 0;
    std::string frame;  ///< of the first message: the scan's, or the odometry's child frame
    std::string why;    ///< the first broken one is
  };
  std::vector<Entry> topics;  ///< in the order in which they occur
  FrameTree frames;
  std::string defect;  ///< empty for an intact file

  /// `/scan (sensor_msgs/LaserScan, 120 messages), /odom ...`; at most 20.
  std::string list() const;
  /// Returns a line for each topic, sorted by name: number of messages, name and type.
  std::string table() const;
};

/// Reads the whole bag. @throws InputError if the file is not a bag, or damaged before its first message
/// @throws std::runtime_error if `isStopped`, which is called at each message, returns true
BagContents contentsOf(
    const std::string& file, const std::function<bool()>& isStopped = [] { return false; });

/// Each scan topic is a laser. Its pose follows from the first transforms between the robot's base and the
/// scan's frame: a laser does not move on the robot.
struct BagPlan {
  /// A laser that is used.
  struct Laser {
    std::string topic;
    mrpt::math::TPose3D pose;  ///< on the robot
    bool isMountingKnown = true;
  };
  std::vector<Laser> lasers;
  std::string odometryTopic;         ///< of nav_msgs/Odometry; empty: from the transforms
  std::string odomFrame, baseFrame;  ///< the transform that is the odometry; empty: none
  std::vector<std::string> notes;    ///< for the user: what was assumed; lasers not used
};

/// Applies the user's choice. By default all lasers are used, and the odometry is that of the only odometry
/// topic, or else the transform from an `odom` frame to the robot's base. The default requires at most one
/// odometry topic and, with several lasers, a separate frame with known pose for each.
/// @throws InputError if there are no scans, a topic is missing, or there is no default; it lists the topics
///         and names the options
BagPlan planOf(const BagContents& contents, const BagOptions& options, const std::string& file);

}  // namespace hybrid_slam::readings
