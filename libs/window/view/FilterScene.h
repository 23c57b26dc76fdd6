/// @file FilterScene.h
/// @brief A filter's state as an mrpt-opengl scene, for the screen, pictures and SceneViewer3D.
#pragma once

#include <mrpt/img/CImage.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CTexturedPlane.h>

#include "window/view/FilterSnapshot.h"

namespace hybrid_slam::window {

/// Pixels.
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
};

/// What is written over the map, a line each: updates, place, lines, verdict. The lines that match are those
/// drawn as such.
std::vector<std::string> captionOf(const FilterSnapshot& filter);

/// The view of the whole map, below the caption.
MapView wholeMap(const MapImage& map, PictureSize size);

/// The grid as a plane, reusable in many scenes: its texture is uploaded once. Null for an empty map.
mrpt::opengl::CTexturedPlane::Ptr mapPlane(const MapImage& map);

/// Grid, path (red), particles (red), line database (green) with the dominating direction, lines of the scan
/// (blue matched, orange not), uncertainty (violet, 3 sigma), robot (light blue circle), and a caption.
/// Everything is in m in the map frame, with the camera above; marker sizes are in pixels at this scale.
/// @param map      mapPlane(filter.map)
/// @param density  screen pixels per pixel of `size`
mrpt::opengl::COpenGLScene::Ptr filterScene(const FilterSnapshot& filter,
                                            const mrpt::opengl::CTexturedPlane::Ptr& map, const MapView& view,
                                            const Layers& layers, PictureSize size, double density = 1);

/// The whole map as a picture of this size, rendered off-screen.
/// @throws std::runtime_error if there is no OpenGL
mrpt::img::CImage pictureOf(const FilterSnapshot& filter, PictureSize size, const Layers& layers);

}  // namespace hybrid_slam::window
