/// @file PointIndex.h
/// @brief Spatial index: finds numbers, such as those of walls, near a point.
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace hybrid_slam {

/// Squares of side `reach`, each with the numbers added there.
class PointIndex {
 public:
  /// @param reach  m: a search finds all numbers up to this far
  explicit PointIndex(double reach) : reach_(reach) {}

  void add(const mrpt::math::TPoint2D& p, int number) {
    std::vector<int>& here = squares_[key(column(p.x), column(p.y))];
    if (here.empty() || here.back() != number) here.push_back(number);
  }
  /// Adds the number at points at most `reach` apart along the stretch from a to b.
  void add(const mrpt::math::TPoint2D& a, const mrpt::math::TPoint2D& b, int number) {
    const int steps = static_cast<int>(std::ceil((b - a).norm() / reach_)) + 1;
    for (int i = 0; i <= steps; ++i) add(a + (b - a) * (static_cast<double>(i) / steps), number);
  }
  /// Calls visit(number) for every number within `reach` of p. Some farther ones are visited too, and a
  /// number may be visited more than once.
  template <class Visit>
  void near(const mrpt::math::TPoint2D& p, const Visit& visit) const {
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const auto found = squares_.find(key(column(p.x) + dx, column(p.y) + dy));
        if (found == squares_.end()) continue;
        for (const int number : found->second) visit(number);
      }
  }

 private:
  int64_t column(double metres) const { return static_cast<int64_t>(std::floor(metres / reach_)); }
  static uint64_t key(int64_t x, int64_t y) {
    return (static_cast<uint64_t>(x) << 32) ^ (static_cast<uint64_t>(y) & 0xffffffffu);
  }

  double reach_;
  std::unordered_map<uint64_t, std::vector<int>> squares_;
};

}  // namespace hybrid_slam
