#include "readings/FrameTree.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/math/CQuaternion.h>

#include <algorithm>
#include <cmath>

namespace hybrid_slam::readings {

using mrpt::poses::CPose3D;

namespace {

constexpr size_t kMostFrames = 10000, kMostAncestors = 100;

bool differs(const CPose3D& a, const CPose3D& b) {
  constexpr double kMetres = 1e-3, kRadians = mrpt::DEG2RAD(0.1);
  const CPose3D step = b - a;
  return step.norm() > kMetres || std::abs(step.yaw()) > kRadians || std::abs(step.pitch()) > kRadians ||
         std::abs(step.roll()) > kRadians;
}

}  // namespace

CPose3D poseOf(const bags::FramePose& p) {
  return {mrpt::math::CQuaternionDouble(p.qw, p.qx, p.qy, p.qz), p.x, p.y, p.z};
}

void FrameTree::add(const bags::TransformMessage& transform) {
  if (edges_.size() >= kMostFrames) return;
  const CPose3D pose = poseOf(transform.pose);
  const auto [edge, isNew] = edges_.try_emplace(transform.childFrame, Edge{transform.header.frame, pose});
  if (isNew) return;
  if (edge->second.parent != transform.header.frame)
    edge->second.hasOtherParent = true;
  else if (!edge->second.moves)
    edge->second.moves = differs(edge->second.pose, pose);
}

std::vector<std::string> FrameTree::ancestors(const std::string& frame) const {
  std::vector<std::string> all{frame};
  for (auto edge = edges_.find(frame); edge != edges_.end() && all.size() < kMostAncestors;
       edge = edges_.find(all.back()))
    all.push_back(edge->second.parent);
  return all;
}

std::vector<std::string> FrameTree::childrenOf(const std::string& part) const {
  std::vector<std::string> children;
  for (const auto& [child, edge] : edges_)
    if (edge.parent.find(part) != std::string::npos) children.push_back(child);
  std::sort(children.begin(), children.end());
  return children;
}

std::optional<std::string> FrameTree::common(const std::string& a, const std::string& b) const {
  const auto ofA = ancestors(a), ofB = ancestors(b);
  const auto found = std::find_first_of(ofA.begin(), ofA.end(), ofB.begin(), ofB.end());
  return found == ofA.end() ? std::nullopt : std::optional(*found);
}

std::vector<const FrameTree::Edge*> FrameTree::edgesUp(const std::string& frame,
                                                       const std::string& ancestor) const {
  std::vector<const Edge*> up;
  for (const std::string& name : ancestors(frame)) {
    if (name == ancestor) break;
    up.push_back(&edges_.at(name));
  }
  return up;
}

std::optional<CPose3D> FrameTree::pose(const std::string& base, const std::string& frame) const {
  const auto top = common(base, frame);
  if (!top) return std::nullopt;
  CPose3D ofBase, ofFrame;  // in the common frame
  for (const Edge* edge : edgesUp(base, *top)) ofBase = edge->pose + ofBase;
  for (const Edge* edge : edgesUp(frame, *top)) ofFrame = edge->pose + ofFrame;
  return ofFrame - ofBase;
}

std::vector<const FrameTree::Edge*> FrameTree::edgesBetween(const std::string& base,
                                                            const std::string& frame) const {
  const auto top = common(base, frame);
  if (!top) return {};
  std::vector<const Edge*> edges = edgesUp(base, *top);
  for (const Edge* edge : edgesUp(frame, *top)) edges.push_back(edge);
  return edges;
}

bool FrameTree::moves(const std::string& base, const std::string& frame) const {
  const auto edges = edgesBetween(base, frame);
  return std::any_of(edges.begin(), edges.end(), [](const Edge* edge) { return edge->moves; });
}

bool FrameTree::isAmbiguous(const std::string& base, const std::string& frame) const {
  const auto edges = edgesBetween(base, frame);
  return std::any_of(edges.begin(), edges.end(), [](const Edge* edge) { return edge->hasOtherParent; });
}

}  // namespace hybrid_slam::readings
