/// @file RayTraversal.h
/// @brief The cells that a ray crosses, in order, with the length in each (Amanatides & Woo 1987).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybrid_slam {

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

}  // namespace hybrid_slam
