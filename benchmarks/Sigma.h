/// @file Sigma.h
/// @brief The standard deviation of errors, a few of which are those of wrong matches.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace hybrid_slam::bench {

/// In the unit of the errors; not a number if there are none.
struct Sigma {
  double robust = NAN;  ///< 68.3 % of the errors are smaller; the standard deviation of normal errors
  double rms = NAN;     ///< root mean square, which a few wrong matches can dominate
};

inline Sigma sigmaOf(std::vector<double> errors) {
  if (errors.empty()) return {};
  double squares = 0;
  for (double& error : errors) {
    error = std::abs(error);
    squares += error * error;
  }
  const auto n = static_cast<double>(errors.size());
  const auto quantile = errors.begin() + static_cast<std::ptrdiff_t>(0.6827 * n);
  std::nth_element(errors.begin(), quantile, errors.end());
  return {*quantile, std::sqrt(squares / n)};
}

}  // namespace hybrid_slam::bench
