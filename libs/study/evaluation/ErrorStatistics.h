/// @file ErrorStatistics.h
/// @brief What is reported of a set of error magnitudes.
#pragma once

#include <vector>

namespace hybrid_slam::evaluation {

/// In the unit of the errors.
struct ErrorStatistics {
  double rmse = 0;
  double mean = 0;
  double median = 0;  ///< of an even number of errors the upper of the two in the middle
  double std = 0;     ///< of these errors, not of a population they are drawn from: the sum is divided by n
  double max = 0;
};

/// @param errors  magnitudes, at least one
ErrorStatistics errorStatistics(std::vector<double> errors);

}  // namespace hybrid_slam::evaluation
