/// @file Segments.h
/// @brief Points of line segments.
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <algorithm>

namespace hybrid_slam {

/// Returns the point of the segment from `a` to `b` that is nearest to `p`; `a` if the segment has no length.
inline mrpt::math::TPoint2D nearestOnSegment(const mrpt::math::TPoint2D& p, const mrpt::math::TPoint2D& a,
                                             const mrpt::math::TPoint2D& b) {
  const mrpt::math::TPoint2D along = b - a, q = p - a;
  const double squaredLength = along.sqrNorm();
  if (squaredLength == 0) return a;
  return a + along * std::clamp((q.x * along.x + q.y * along.y) / squaredLength, 0.0, 1.0);
}

}  // namespace hybrid_slam
