/// @file FrameTree.h
/// @brief Tree of a robot's frames, from its transforms.
#pragma once

#include <mrpt/poses/CPose3D.h>

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "bags/Messages.h"

namespace hybrid_slam::readings {

/// Returns a pose of ROS as one of MRPT.
mrpt::poses::CPose3D poseOf(const bags::FramePose& pose);

/// Keeps the parent and the pose of each frame's first transform.
class FrameTree {
 public:
  void add(const bags::TransformMessage& transform);

  /// Returns the frame, its parent, and so on; at most 100.
  std::vector<std::string> ancestors(const std::string& frame) const;
  /// Returns the frames whose parent has a name that contains `part`, sorted.
  std::vector<std::string> childrenOf(const std::string& part) const;
  /// Returns the pose of `frame` in `base` (m, rad); empty if they are not connected.
  std::optional<mrpt::poses::CPose3D> pose(const std::string& base, const std::string& frame) const;
  /// Returns whether a transform between two frames has changed by over 1 mm or 0.1 deg.
  bool moves(const std::string& base, const std::string& frame) const;
  /// Returns whether a frame between them has transforms from different parents.
  bool isAmbiguous(const std::string& base, const std::string& frame) const;

 private:
  struct Edge {
    std::string parent;
    mrpt::poses::CPose3D pose;  ///< in the parent
    bool moves = false, hasOtherParent = false;
  };
  /// Returns the edges on the way between two frames; none if they are not connected.
  std::vector<const Edge*> edgesBetween(const std::string& base, const std::string& frame) const;
  /// Returns the edges from a frame up to one of its ancestors.
  std::vector<const Edge*> edgesUp(const std::string& frame, const std::string& ancestor) const;
  /// Returns the nearest common ancestor, which may be either of them; empty if there is none.
  std::optional<std::string> common(const std::string& a, const std::string& b) const;

  std::unordered_map<std::string, Edge> edges_;  ///< by child
};

}  // namespace hybrid_slam::readings
