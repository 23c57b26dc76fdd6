/// @file Path.h
/// @brief A particle's trajectory, shared between particles with common ancestors.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace hybrid_slam {

/// The poses of one trajectory hypothesis, newest last (map frame). Copying costs one pointer for any length;
/// common parts of two paths are stored once.
class Path {
 public:
  void push(const mrpt::math::TPose2D& pose) {
    const size_t length = size() + 1;
    last_ = std::make_shared<Node>(pose, length, std::move(last_));
  }
  bool empty() const { return !last_; }
  size_t size() const { return last_ ? last_->length : 0; }
  /// The newest pose; the origin of the map before the first one.
  mrpt::math::TPose2D back() const { return last_ ? last_->pose : mrpt::math::TPose2D(); }
  /// The last motion, in the frame of the previous pose; zero if there is none.
  mrpt::math::TPose2D lastMotion() const {
    return size() > 1 ? last_->pose - last_->parent->pose : mrpt::math::TPose2D();
  }
  bool sharesWith(const Path& other) const { return last_ == other.last_; }

  /// All poses, oldest first.
  std::vector<mrpt::math::TPose2D> poses() const { return newest(size()); }
  /// The newest poses, oldest first: `count`, or all if there are fewer.
  std::vector<mrpt::math::TPose2D> newest(size_t count) const {
    std::vector<mrpt::math::TPose2D> poses(std::min(count, size()));
    const Node* node = last_.get();
    for (size_t i = poses.size(); i-- > 0; node = node->parent.get()) poses[i] = node->pose;
    return poses;
  }

  /// Visits the nodes of the path. Nodes that several paths share are written once.
  template <class State>
  void visit(State& state) {
    uint32_t shared = 0;
    size_t count = 0;
    if constexpr (State::kIsReading) {
      state(shared, count);
      last_ = shared > 0 ? state.template at<Node>(shared) : nullptr;
      for (size_t i = 0; i < count; ++i) {
        mrpt::math::TPose2D pose;
        state(pose);
        push(pose);
        state.add(last_);
      }
    } else {
      std::vector<Node*> own;
      Node* node = last_.get();
      for (; node && !state.numberOf(node); node = node->parent.get()) own.push_back(node);
      shared = node ? state.numberOf(node) : 0;
      count = own.size();
      state(shared, count);
      for (auto at = own.rbegin(); at != own.rend(); ++at) {
        state((*at)->pose);
        state.add(*at);
      }
    }
  }

 private:
  struct Node {
    Node(const mrpt::math::TPose2D& p, size_t n, std::shared_ptr<Node> before)
        : pose(p), length(n), parent(std::move(before)) {}
    Node(const Node&) = delete;
    Node& operator=(const Node&) = delete;
    /// Frees unshared ancestors in a loop: recursion would overflow the stack after an hour of driving.
    ~Node() {
      std::shared_ptr<Node> node = std::move(parent);
      while (node && node.use_count() == 1) node = std::move(node->parent);
    }
    mrpt::math::TPose2D pose;
    size_t length;
    std::shared_ptr<Node> parent;
  };
  std::shared_ptr<Node> last_;
};

}  // namespace hybrid_slam
