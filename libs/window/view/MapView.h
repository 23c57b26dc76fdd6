/// @file MapView.h
/// @brief The part of the map that a picture shows, and the layers drawn over it.
#pragma once

#include <mrpt/math/TPoint2D.h>

namespace hybrid_slam::window {

/// Size in pixels.
struct PictureSize {
  int width = 0, height = 0;
};

/// The part of the map frame that a picture shows, from above.
struct MapView {
  double centreX = 0, centreY = 0;  ///< m, map frame, at the middle of the picture
  double scale = 20;                ///< pixels per m; y points up in the map, down on the screen

  mrpt::math::TPoint2D toPicture(double x, double y, PictureSize size) const {
    return {size.width / 2.0 + (x - centreX) * scale, size.height / 2.0 - (y - centreY) * scale};
  }
  mrpt::math::TPoint2D toMap(double x, double y, PictureSize size) const {
    return {centreX + (x - size.width / 2.0) / scale, centreY - (y - size.height / 2.0) / scale};
  }
};

/// Layers drawn over the grid.
struct Layers {
  bool particles = true, path = true, lines = true, scanLines = true, ellipse = true;
  bool legend = true;  ///< with the scale bar
};

}  // namespace hybrid_slam::window
