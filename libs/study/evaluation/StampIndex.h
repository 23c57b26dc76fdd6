/// @file StampIndex.h
/// @brief The row of a table that is nearest in time.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "files/Trajectory.h"

namespace hybrid_slam::evaluation {

/// Timestamps of a trajectory in order of time, each with the row where it stands.
class StampIndex {
 public:
  explicit StampIndex(const files::Trajectory& trajectory);

  /// The row nearest to `timestamp` if it is at most `tolerance` away (both in s). Of two rows equally far
  /// the earlier one; of rows with the same stamp the last if it is not after `timestamp`, else the first.
  std::optional<size_t> nearest(double timestamp, double tolerance) const;

 private:
  std::vector<std::pair<double, size_t>> stamps_;
};

}  // namespace hybrid_slam::evaluation
