/// @file ErrorStatistics.h
/// @brief Statistics of error magnitudes.
#pragma once

#include <vector>

namespace hybrid_slam::evaluation {

/// Statistics of error magnitudes, in the unit of the errors.
struct ErrorStatistics {
  double rmse = 0;
  double mean = 0;
  double median = 0;  ///< for an even number, the upper of the two middle errors
  double std = 0;     ///< of the errors themselves, not of a population: the sum is divided by n
  double max = 0;
};

/// @param errors  magnitudes, at least one
ErrorStatistics errorStatistics(std::vector<double> errors);

}  // namespace hybrid_slam::evaluation
