/// @file StampIndex.h
/// @brief Finds the row of a trajectory nearest in time.
#pragma once

#include <cstddef>
#include <map>
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
  friend class StampSequence;
  using Stamps = std::vector<std::pair<double, size_t>>;
  Stamps::const_iterator find(double timestamp, double tolerance) const;

  Stamps stamps_;
};

/// Finds the row nearest in time for each of a sequence of timestamps. If a timestamp repeats, so does that
/// of the rows: each time it is the next of them, and the last of them from then on.
class StampSequence {
 public:
  /// @param tolerance  s
  StampSequence(const files::Trajectory& trajectory, double tolerance)
      : index_(trajectory), tolerance_(tolerance) {}
  std::optional<size_t> next(double timestamp);

 private:
  StampIndex index_;
  double tolerance_;
  std::map<double, std::ptrdiff_t> times_;  ///< that a timestamp has occurred
};

}  // namespace hybrid_slam::evaluation
