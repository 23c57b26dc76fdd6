/// @file SceneLegend.h
/// @brief The strip at the lower edge of a pane: a scale bar and the legend of the colours.
#pragma once

#include <mrpt/img/TColor.h>
#include <mrpt/opengl/COpenGLScene.h>

#include <string>
#include <vector>

#include "window/view/FilterSnapshot.h"
#include "window/view/MapView.h"

namespace hybrid_slam::window {

/// A symbol and what it stands for.
struct LegendEntry {
  enum class Symbol { area, stroke, arrow, circle, ellipse };
  std::string label;
  mrpt::img::TColor colour;
  Symbol symbol;
};

/// Returns an entry for each drawn item: none for hidden layers, or for lines if the filter has none.
std::vector<LegendEntry> legendOf(const FilterSnapshot& filter, const Layers& layers);

/// Returns a length (m) for the scale bar: 1, 2 or 5 times a power of ten, at most 80 pixels long.
/// @param scale  pixels per m
double scaleBarLength(double scale);

/// Positions of the entries in the strip.
struct LegendLayout {
  std::vector<LegendEntry> entries;
  std::vector<mrpt::math::TPoint2D> places;  ///< pixels, right and down from the strip's upper left corner
  double height = 0;                         ///< pixels; 0 if the legend is hidden
};

/// Height (pixels) of a strip with all entries. The actual height varies from scan to scan, and between
/// filters.
double legendRoom(const Layers& layers, PictureSize size);

/// Places the entries in rows of the picture's width, after the scale bar.
LegendLayout legendLayout(const FilterSnapshot& filter, const Layers& layers, PictureSize size);

/// Adds the strip to a scene with this view.
/// @param above    of everything else, m
/// @param density  screen pixels per pixel of `size`
void addLegend(mrpt::opengl::COpenGLScene& scene, const LegendLayout& layout, const MapView& view,
               PictureSize size, double above, double density);

}  // namespace hybrid_slam::window
