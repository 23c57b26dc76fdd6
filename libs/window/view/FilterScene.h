/// @file FilterScene.h
/// @brief A filter's state as an mrpt-opengl scene, for the screen, pictures and SceneViewer3D.
#pragma once

#include <mrpt/img/CImage.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CTexturedPlane.h>

#include "window/view/FilterSnapshot.h"
#include "window/view/MapView.h"

namespace hybrid_slam::window {

/// What is written over the map, a line each: updates, place, lines, verdict. The lines that match are those
/// drawn as such.
std::vector<std::string> captionOf(const FilterSnapshot& filter);

/// The view of the whole map, between the caption and room for the whole legend: side by side, maps of the
/// same size are drawn alike.
MapView wholeMap(const MapImage& map, const Layers& layers, PictureSize size);

/// The grid as a plane, reusable in many scenes: its texture is uploaded once. Null for an empty map.
mrpt::opengl::CTexturedPlane::Ptr mapPlane(const MapImage& map);

/// Grid, path (red), particles (red), line database (green) with the dominating direction, lines of the scan
/// (blue matched, orange not), uncertainty (violet, 3 sigma), robot (light blue circle), a caption,
/// and a legend with a scale bar.
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
