/// @file FrameTree.h
/// @brief The frames of a robot, from its transforms.
#pragma once

#include <mrpt/poses/CPose3D.h>

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "bags/Messages.h"

namespace hybrid_slam::readings {

mrpt::poses::CPose3D poseOf(const bags::FramePose& pose);

/// Each frame has the parent and the pose of its first transform.
class FrameTree {
 public:
  void add(const bags::TransformMessage& transform);

  /// The frame, its parent, and so on; at most 100.
  std::vector<std::string> ancestors(const std::string& frame) const;
  /// Pose of a frame in another (m, rad); empty if they are not connected.
  std::optional<mrpt::poses::CPose3D> pose(const std::string& base, const std::string& frame) const;
  /// Whether one of the transforms between two frames has changed by over 1 mm or 0.1 deg.
  bool moves(const std::string& base, const std::string& frame) const;

 private:
  struct Edge {
    std::string parent;
    mrpt::poses::CPose3D pose;  ///< in the parent
    bool moves = false;
  };
  /// The edges from a frame up to one of its ancestors.
  std::vector<const Edge*> edgesUp(const std::string& frame, const std::string& ancestor) const;
  /// The nearest frame above both, or one of them; empty if there is none.
  std::optional<std::string> common(const std::string& a, const std::string& b) const;

  std::unordered_map<std::string, Edge> edges_;  ///< by child
};

}  // namespace hybrid_slam::readings
