#include "study/evaluation/ErrorStatistics.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace hybrid_slam::evaluation {

ErrorStatistics errorStatistics(std::vector<double> errors) {
  if (errors.empty()) throw std::invalid_argument("statistics of no errors");
  std::sort(errors.begin(), errors.end());
  const double n = static_cast<double>(errors.size());
  ErrorStatistics result;
  double squares = 0, deviations = 0;
  for (const double e : errors) {
    result.mean += e / n;
    squares += e * e;
  }
  for (const double e : errors) deviations += (e - result.mean) * (e - result.mean);
  result.rmse = std::sqrt(squares / n);
  result.std = std::sqrt(deviations / n);
  result.median = errors[errors.size() / 2];
  result.max = errors.back();
  return result;
}

}  // namespace hybrid_slam::evaluation
