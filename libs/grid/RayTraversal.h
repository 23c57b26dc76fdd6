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

/// Walks the cells that a ray crosses and calls visit(x, y, entry, exit) with the distances (in cells) from
/// the origin at which the ray enters and leaves the cell, until `length` is reached or visit returns false.
/// A cell that the ray only touches, at a corner or where it starts on a border, is not crossed.
/// @param originX,originY  in cells (m / cell size), map frame
/// @param dirX,dirY        unit vector
/// @param length           in cells
template <class Visit>
void traverseRay(double originX, double originY, double dirX, double dirY, double length, Visit&& visit) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  int x = static_cast<int>(std::floor(originX)), y = static_cast<int>(std::floor(originY));
  const int stepX = dirX > 0 ? 1 : -1, stepY = dirY > 0 ? 1 : -1;
  const double deltaX = dirX != 0 ? std::abs(1 / dirX) : kNever;
  const double deltaY = dirY != 0 ? std::abs(1 / dirY) : kNever;
  double nextX = dirX != 0 ? (dirX > 0 ? x + 1 - originX : originX - x) * deltaX : kNever;
  double nextY = dirY != 0 ? (dirY > 0 ? y + 1 - originY : originY - y) * deltaY : kNever;
  double entry = 0;
  while (entry < length) {
    const double exit = std::min(std::min(nextX, nextY), length);
    if (exit > entry && !visit(x, y, entry, exit)) return;
    entry = exit;
    if (nextX < nextY) {
      x += stepX;
      nextX += deltaX;
    } else {
      y += stepY;
      nextY += deltaY;
    }
  }
}

/// As traverseRay, but leaves out squares of cells known to be free (see Tile): calls visit(value, entry,
/// exit) with the cells' values. Inlined, so that what `visit` counts stays in registers.
template <class Visit>
[[gnu::always_inline]] inline void traverseObstacles(TileReader& cells, double originX, double originY,
                                                     double dirX, double dirY, double length,
                                                     const Visit& visit) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  static constexpr Tile::Cells kUnknown{};
  constexpr int kSize = Tile::kSquareSize, kSquaresInTile = Tile::kBits - Tile::kSquareBits;
  const double perX = dirX != 0 ? 1 / dirX : kNever, perY = dirY != 0 ? 1 / dirY : kNever;
  const double deltaX = std::abs(perX), deltaY = std::abs(perY);
  const int aheadX = dirX > 0, aheadY = dirY > 0;  // the border in front: of the cell itself, or of the next
  const int stepX = 2 * aheadX - 1, stepY = 2 * aheadY - 1;
  const auto borderX = [&](int x) { return dirX != 0 ? (x - originX) * perX : kNever; };
  const auto borderY = [&](int y) { return dirY != 0 ? (y - originY) * perY : kNever; };

  // All cells between entry and end, in one square. @return what the last visit did
  const auto walkSquare = [&](const Tile::Cells& values, int firstX, int firstY, double entry, double end)
      __attribute__((always_inline)) {
    // Rounding may put the entry outside.
    int x = std::clamp(floorOf(originX + entry * dirX), firstX, firstX + kSize - 1);
    int y = std::clamp(floorOf(originY + entry * dirY), firstY, firstY + kSize - 1);
    double nextX = borderX(x + aheadX), nextY = borderY(y + aheadY);
    while (entry < end) {
      const double exit = std::min(std::min(nextX, nextY), end);
      if (exit > entry && !visit(values[Tile::index(x, y)], entry, exit)) return false;
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
  };

  int x = floorOf(originX) >> Tile::kSquareBits, y = floorOf(originY) >> Tile::kSquareBits;  // of a square
  double nextX = borderX((x + aheadX) * kSize), nextY = borderY((y + aheadY) * kSize);
  double entry = 0;
  while (entry < length) {
    const double exit = std::min(std::min(nextX, nextY), length);
    const Tile* const tile = cells.tile(x >> kSquaresInTile, y >> kSquaresInTile);
    if (!(tile && tile->isFree(x, y)) &&
        !walkSquare(tile ? tile->cells() : kUnknown, x * kSize, y * kSize, entry, exit))
      return;
    entry = exit;
    if (nextX < nextY) {
      x += stepX;
      nextX += kSize * deltaX;
    } else {
      y += stepY;
      nextY += kSize * deltaY;
    }
  }
}

}  // namespace hybrid_slam
