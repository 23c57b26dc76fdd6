/// @file FilterScene.h
/// @brief A filter's state as an mrpt-opengl scene, for the screen, pictures and SceneViewer3D.
#pragma once

#include <mrpt/img/CImage.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CTexturedPlane.h>

#include "window/view/FilterSnapshot.h"
#include "window/view/MapView.h"

namespace hybrid_slam::window {

/// Returns the caption of the map, one item per line: updates, place, lines, verdict. Its
/// number of matched lines is that of the blue lines in filterScene.
std::vector<std::string> captionOf(const FilterSnapshot& filter);

/// Returns a view of the whole map, between the caption and room for the complete legend, so that maps of the
/// same size have the same scale side by side.
MapView wholeMap(const MapImage& map, const Layers& layers, PictureSize size);

/// Returns the grid as a plane, reusable in many scenes: its texture is uploaded once. Null for an empty map.
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

/// Renders the whole map off-screen as a picture of this size.
/// @throws std::runtime_error if there is no OpenGL
mrpt::img::CImage pictureOf(const FilterSnapshot& filter, PictureSize size, const Layers& layers);

}  // namespace hybrid_slam::window
