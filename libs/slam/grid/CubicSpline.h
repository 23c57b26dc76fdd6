/// @file CubicSpline.h
/// @brief The uniform cubic B-spline: smooth interpolation of regular samples.
#pragma once

namespace hybrid_slam {

/// Four floats in one SIMD register.
using Float4 = float __attribute__((vector_size(16)));

/// Sum of the four elements.
inline float sum(Float4 v) { return (v[0] + v[1]) + (v[2] + v[3]); }

/// The weights of the samples at -1, 0, 1 and 2 for position t in [0, 1), and their derivatives with respect
/// to t. The spline reproduces constant and linear functions and blurs others by 0.58 samples.
struct SplineWeights {
  explicit SplineWeights(float t)
      : value(kConstant + t * (kLinear + t * (kSquare + t * kCube))),
        slope(kLinear + t * (2 * kSquare + t * (3 * kCube))) {}
  Float4 value, slope;

 private:
  // (1-t)^3, 4 - 6 t^2 + 3 t^3, 1 + 3 t + 3 t^2 - 3 t^3, t^3; all / 6
  static constexpr Float4 kConstant{1.f / 6, 4.f / 6, 1.f / 6, 0}, kLinear{-0.5f, 0, 0.5f, 0},
      kSquare{0.5f, -1, 0.5f, 0}, kCube{-1.f / 6, 0.5f, -0.5f, 1.f / 6};
};

}  // namespace hybrid_slam
