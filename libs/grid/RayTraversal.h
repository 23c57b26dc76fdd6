/// @file RayTraversal.h
/// @brief The cells that a ray crosses, in order, with the length in each (Amanatides & Woo 1987).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "grid/TileGrid.h"

namespace hybrid_slam {

/// std::floor is slow where the processor's own rounding cannot be taken for granted.
inline int floorOf(double x) {
  const int towardsZero = static_cast<int>(x);
  return towardsZero - (x < towardsZero);
}

/// Where a ray stands between the lines of a grid of squares: the next one on each axis.
struct RaySteps {
  int x, y, stepX, stepY;
  double nextX, nextY, deltaX, deltaY;  ///< distances from the ray's origin; between two lines

  /// Calls visit(x, y, entry, exit) for each square from `entry` to `end`, until that returns false.
  /// @return what the last visit did
  template <class Visit>
  [[gnu::always_inline]] inline bool walk(double entry, double end, const Visit& visit) {
    while (entry < end) {
      const double exit = std::min(std::min(nextX, nextY), end);
      if (exit > entry && !visit(x, y, entry, exit)) return false;
      entry = exit;
      if (nextX < nextY) {
        x += stepX;
        nextX += deltaX;
      } else {
        y += stepY;
        nextY += deltaY;
      }
    }
    return true;
  }
};

/// Walks the cells that a ray crosses and calls visit(x, y, entry, exit) with the distances (in cells) from
/// the origin at which the ray enters and leaves the cell, until `length` is reached or visit returns false.
/// A cell that the ray only touches, at a corner or where it starts on a border, is not crossed.
/// @param originX,originY  in cells (m / cell size), map frame
/// @param dirX,dirY        unit vector
/// @param length           in cells
template <class Visit>
void traverseRay(double originX, double originY, double dirX, double dirY, double length, Visit&& visit) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const int x = static_cast<int>(std::floor(originX)), y = static_cast<int>(std::floor(originY));
  const double deltaX = dirX != 0 ? std::abs(1 / dirX) : kNever;
  const double deltaY = dirY != 0 ? std::abs(1 / dirY) : kNever;
  const double nextX = dirX != 0 ? (dirX > 0 ? x + 1 - originX : originX - x) * deltaX : kNever;
  const double nextY = dirY != 0 ? (dirY > 0 ? y + 1 - originY : originY - y) * deltaY : kNever;
  RaySteps steps{x, y, dirX > 0 ? 1 : -1, dirY > 0 ? 1 : -1, nextX, nextY, deltaX, deltaY};
  steps.walk(0, length, visit);
}

/// As traverseRay, but leaves out squares of cells known to be free (see Tile): calls visit(value, entry,
/// exit) with the cells' values. Inlined, so that what `visit` counts stays in registers.
template <class Visit>
[[gnu::always_inline]] inline void traverseObstacles(TileReader& cells, double originX, double originY,
                                                     double dirX, double dirY, double length,
                                                     const Visit& visit) {
  static constexpr Tile::Cells kUnknown{};
  constexpr double kNever = std::numeric_limits<double>::infinity();
  constexpr int kSize = Tile::kSquareSize, kSquaresInTile = Tile::kBits - Tile::kSquareBits;
  const double perX = dirX != 0 ? 1 / dirX : kNever, perY = dirY != 0 ? 1 / dirY : kNever;
  const int aheadX = dirX > 0, aheadY = dirY > 0;  // the border in front: of the cell itself, or of the next
  // Steps from cell to cell (size 1) or from square to square, beginning in (x, y).
  const auto stepsFrom = [&](int x, int y, int size) __attribute__((always_inline)) {
    return RaySteps{x,
                    y,
                    2 * aheadX - 1,
                    2 * aheadY - 1,
                    dirX != 0 ? ((x + aheadX) * size - originX) * perX : kNever,
                    dirY != 0 ? ((y + aheadY) * size - originY) * perY : kNever,
                    size * std::abs(perX),
                    size * std::abs(perY)};
  };
  // Rounding may put the entry into a square outside of it.
  const auto within = [](double place, int square) {
    return std::clamp(floorOf(place), square * kSize, square * kSize + kSize - 1);
  };
  RaySteps squares =
      stepsFrom(floorOf(originX) >> Tile::kSquareBits, floorOf(originY) >> Tile::kSquareBits, kSize);
  squares.walk(
      0, length, [&](int squareX, int squareY, double entry, double end) __attribute__((always_inline)) {
        const Tile* const tile = cells.tile(squareX >> kSquaresInTile, squareY >> kSquaresInTile);
        if (tile && tile->isFree(squareX, squareY)) return true;
        const Tile::Cells& values = tile ? tile->cells() : kUnknown;
        RaySteps steps =
            stepsFrom(within(originX + entry * dirX, squareX), within(originY + entry * dirY, squareY), 1);
        return steps.walk(
            entry, end, [&](int x, int y, double in, double out) __attribute__((always_inline)) {
              return visit(values[Tile::index(x, y)], in, out);
            });
      });
}

}  // namespace hybrid_slam
