/// @file TimeLeft.h
/// @brief Estimates the remaining time of a run.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace hybrid_slam::run {

/// Scans take longer as the map grows and loops close, so the time is extrapolated as a d + b d^2 of the d
/// scans done, with b >= 0. Writing the results takes about another quarter.
class TimeLeft {
 public:
  explicit TimeLeft(size_t total) : total_(total) {}

  /// @param elapsed  s since the start, not less than before
  /// @return s; empty in the first 2 s or 2 %, which say little
  std::optional<double> after(size_t done, double elapsed);

 private:
  /// The time (s) at which half as many scans were done, interpolated.
  double timeOfHalf(double done) const;

  size_t total_;
  std::vector<std::pair<double, double>> past_{{0, 0}};  ///< scans done, s; about 200 at most
};

}  // namespace hybrid_slam::run
