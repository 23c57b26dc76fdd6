/// @file SpreadNormals.h
/// @brief Evenly spread (quasi-random) normal numbers for all particles of a step.
#pragma once

#include <mrpt/math/distributions.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/RandomStream.h"

namespace hybrid_slam {

/// Standard normal numbers for D, C and T: particle i takes the i-th point of the Kronecker sequence
///     u_k = frac(shift_k + i g^-k),  k = 1, 2, 3,  g^4 = g + 1
/// (Roberts 2018, the R-sequence) to the normal quantiles. The shift is drawn uniformly, so each particle's
/// numbers are distributed like independent draws. But particles with neighbouring indices, such as copies
/// made by resampling, get well-spread numbers without clusters and gaps. Only the triple is evenly spread:
/// over 20 particles, the mean of a likelihood of D, C and T has 0.22 of the variance of independent draws,
/// that of C alone 1.6 times as much.
class SpreadNormals {
 public:
  explicit SpreadNormals(RandomStream random) {
    for (double& shift : shift_) shift = random.uniform();
  }

  std::array<double, 3> operator()(size_t particle) const {
    constexpr double kG = 1.2207440846057596;
    constexpr std::array<double, 3> kStep{1 / kG, 1 / (kG * kG), 1 / (kG * kG * kG)};
    std::array<double, 3> normals;
    for (size_t k = 0; k < normals.size(); ++k) {
      const double u = shift_[k] + static_cast<double>(particle) * kStep[k];
      normals[k] = mrpt::math::normalQuantile(std::max(u - std::floor(u), 0x1p-53));  // infinite at 0
    }
    return normals;
  }

 private:
  std::array<double, 3> shift_;
};

}  // namespace hybrid_slam
