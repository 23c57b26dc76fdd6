/// @file FilterDrawing.h
/// @brief One filter's state as a picture: on the screen and in a file.
#pragma once

#include <wx/bitmap.h>
#include <wx/graphics.h>

#include "view/FilterSnapshot.h"

namespace hybrid_slam {

/// Which part of the map frame a picture shows.
struct MapView {
  double centreX = 0, centreY = 0;  ///< m, map frame, at the middle of the picture
  double scale = 20;                ///< pixels per m; y points up in the map, down on the screen

  wxPoint2DDouble toPicture(double x, double y, const wxSize& size) const {
    return {size.x / 2.0 + (x - centreX) * scale, size.y / 2.0 - (y - centreY) * scale};
  }
  wxPoint2DDouble toMap(const wxPoint& at, const wxSize& size) const {
    return {centreX + (at.x - size.x / 2.0) / scale, centreY - (at.y - size.y / 2.0) / scale};
  }
};

/// What is drawn over the grid.
struct Layers {
  bool particles = true, path = true, lines = true, scanLines = true, ellipse = true;
};

/// The view that holds the whole map.
MapView wholeMap(const MapImage& map, const wxSize& size);

/// A pixel for each cell; not valid for an empty map.
wxBitmap mapBitmap(const MapImage& map);

/// Grid, path (red), particles (red), line database (green) with the dominating direction, lines of the scan
/// (blue matched, orange not), uncertainty (violet, 3 sigma), robot (light blue circle), and a caption.
/// @param map  mapBitmap(filter.map)
void drawFilter(wxGraphicsContext& to, const wxSize& size, const FilterSnapshot& filter, const wxBitmap& map,
                const MapView& view, const Layers& layers);

/// The whole map of this many pixels as a bitmap, for a file.
wxBitmap pictureOf(const FilterSnapshot& filter, const wxSize& size, const Layers& layers);

}  // namespace hybrid_slam
