/// @file Median.h
/// @brief The median of numbers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace hybrid_slam {

/// Returns the median; of an even number of values, the larger one in the middle. Requires at least one.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace hybrid_slam
