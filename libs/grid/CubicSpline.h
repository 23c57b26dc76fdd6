/// @file CubicSpline.h
/// @brief The uniform cubic B-spline: a smooth function through the neighbourhood of regular samples.
#pragma once

#include <array>

namespace hybrid_slam {

/// The weights of the samples at -1, 0, 1 and 2 for the place t in [0, 1), and their derivatives by t. The
/// spline keeps constant and linear functions, and blurs the others by 0.58 samples.
struct SplineWeights {
  explicit SplineWeights(double t) {
    const double u = 1 - t;
    value = {u * u * u / 6, (4 - 6 * t * t + 3 * t * t * t) / 6, (4 - 6 * u * u + 3 * u * u * u) / 6,
             t * t * t / 6};
    slope = {-u * u / 2, (3 * t * t - 4 * t) / 2, (4 * u - 3 * u * u) / 2, t * t / 2};
  }
  std::array<double, 4> value, slope;
};

}  // namespace hybrid_slam
