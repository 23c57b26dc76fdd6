/// @file RaySamples.h
/// @brief Evenly spaced samples along a ray, in grid cells.
#pragma once

#include <cstdint>

#include "slam/grid/Tile.h"

namespace hybrid_slam {

/// Rounds down. Faster than std::floor, which cannot assume the processor's rounding instruction.
inline int floorOf(double x) {
  const int towardsZero = static_cast<int>(x);
  return towardsZero - (x < towardsZero);
}

/// A fixed-point coordinate: a cell is 2^32, so the cell index is a shift.
inline int64_t fixedPoint(double cells) { return static_cast<int64_t>(cells * 0x1p32); }

/// A sample that moves along a ray by a constant step. In fixed point a step is one addition, without
/// branches that depend on the ray.
class RaySamples {
 public:
  /// The first sample and the step, in cells.
  RaySamples(double x, double y, double stepX, double stepY)
      : x_(fixedPoint(x)), y_(fixedPoint(y)), stepX_(fixedPoint(stepX)), stepY_(fixedPoint(stepY)) {}

  int cellX() const { return static_cast<int>(x_ >> kBits); }
  int cellY() const { return static_cast<int>(y_ >> kBits); }
  /// Squares of 8 x 8 cells, as in Tile.
  int squareX() const { return static_cast<int>(x_ >> (kBits + Tile::kSquareBits)); }
  int squareY() const { return static_cast<int>(y_ >> (kBits + Tile::kSquareBits)); }
  int tileX() const { return static_cast<int>(x_ >> (kBits + Tile::kBits)); }
  int tileY() const { return static_cast<int>(y_ >> (kBits + Tile::kBits)); }
  void advance(int steps = 1) { x_ += steps * stepX_, y_ += steps * stepY_; }
  RaySamples ahead(int steps) const {
    RaySamples there(*this);
    there.advance(steps);
    return there;
  }

 private:
  static constexpr int kBits = 32;

  int64_t x_, y_, stepX_, stepY_;
};

}  // namespace hybrid_slam
