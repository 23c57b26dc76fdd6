/// @file Checkpoints.h
/// @brief States of a replay, to go back without replaying from the beginning.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "window/view/FilterSnapshot.h"

namespace hybrid_slam::window {

/// State of a replay after some scans.
struct Checkpoint {
  /// The state of one method.
  struct Lane {
    std::string run;  ///< FilterRun::state
    FilterWatch watch;
  };
  double start = 0, time = 0;  ///< s: time of the first scan; time since
  std::vector<Lane> lanes;

  size_t bytes() const;
};

/// Checkpoints at regular scans. When they take more memory than allowed, every second one is dropped, and
/// the later ones are twice as far apart.
class Checkpoints {
 public:
  static constexpr size_t kEvery = 25;  ///< scans
  static constexpr size_t kMostBytes = size_t{1} << 28;

  /// @param mostBytes  of all checkpoints; the newest one may exceed it
  explicit Checkpoints(size_t mostBytes = kMostBytes) : mostBytes_(mostBytes) {}

  /// Returns whether one should be added after this scan.
  bool isDue(size_t scans) const;
  void add(size_t scans, Checkpoint checkpoint);
  /// Returns the last one up to this scan, with its number of scans; null if there is none.
  const std::pair<const size_t, Checkpoint>* upTo(size_t scans) const;
  size_t every() const { return every_; }
  size_t size() const { return all_.size(); }

 private:
  size_t mostBytes_, every_ = kEvery, bytes_ = 0;
  std::map<size_t, Checkpoint> all_;  ///< by the number of scans
};

}  // namespace hybrid_slam::window
