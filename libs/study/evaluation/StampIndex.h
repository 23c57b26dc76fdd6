/// @file StampIndex.h
/// @brief Finds the row of a trajectory nearest in time.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "files/Trajectory.h"

namespace hybrid_slam::evaluation {

constexpr double kTimeTolerance = 0.001;  ///< s, of timestamps that a text file rounds

/// The timestamps of a trajectory in ascending order, each with its row.
class StampIndex {
 public:
  explicit StampIndex(const files::Trajectory& trajectory);

  /// Returns the row nearest to `timestamp` within `tolerance` (both in s). Of two rows at equal distance,
  /// the earlier; of rows with the same timestamp, the last if it is not after `timestamp`, else the first.
  std::optional<size_t> nearest(double timestamp, double tolerance) const;

 private:
  std::vector<std::pair<double, size_t>> stamps_;
};

}  // namespace hybrid_slam::evaluation
