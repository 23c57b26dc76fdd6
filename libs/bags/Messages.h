/// @file Messages.h
/// @brief The ROS messages that are read, decoded from their published layout.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace hybrid_slam::bags {

/// Encoding of a message: ROS 1 (no padding), or CDR (ROS 2; numbers are aligned to their size).
enum class Encoding { ros1, cdr };

/// Larger messages are not decoded. A scan of a million beams with intensities has 8 MB.
constexpr size_t kMostMessageBytes = size_t{16} << 20;

/// A std_msgs/Header.
struct MessageHeader {
  double time = 0;    ///< s; 0: not set
  std::string frame;  ///< without the leading slash of old ROS versions
};

/// A sensor_msgs/LaserScan, or the first echoes of a sensor_msgs/MultiEchoLaserScan.
struct ScanMessage {
  MessageHeader header;                ///< time: of the first beam
  double angleMin = 0, angleStep = 0;  ///< rad, counter-clockwise about the frame's z axis
  double timeStep = 0;                 ///< s, from beam to beam
  double rangeMin = 0, rangeMax = 0;   ///< m
  std::vector<float> ranges;           ///< m; NaN and infinite where there is no return
};

/// Pose of a frame in its parent: m, and a unit quaternion.
struct FramePose {
  double x = 0, y = 0, z = 0;
  double qx = 0, qy = 0, qz = 0, qw = 1;
};

/// A nav_msgs/Odometry.
struct OdometryMessage {
  MessageHeader header;
  std::string childFrame;
  FramePose pose;
};

/// A transform of a tf2_msgs/TFMessage or tf/tfMessage, which hold several. Invalid rotations are left out.
struct TransformMessage {
  MessageHeader header;  ///< frame: the parent
  std::string childFrame;
  FramePose pose;
};

using Message = std::variant<ScanMessage, OdometryMessage, std::vector<TransformMessage>>;

/// The kinds of messages that are read.
enum class MessageType { laserScan, multiEchoLaserScan, odometry, transforms };

/// Returns the type with this name in ROS 1 (`sensor_msgs/LaserScan`) or 2 (`sensor_msgs/msg/LaserScan`);
/// empty for a type that is not read.
std::optional<MessageType> messageTypeOf(std::string_view name);

/// @throws BrokenBytes for bytes that are not a message of this type, or impossible values
Message decodeMessage(MessageType type, Encoding encoding, std::string_view bytes);

}  // namespace hybrid_slam::bags
