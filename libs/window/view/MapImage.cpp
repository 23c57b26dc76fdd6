#include "window/view/MapImage.h"

#include <algorithm>
#include <cmath>

#include "base/Numbers.h"

namespace hybrid_slam::window {

std::string describeCell(const MapImage& map, double x, double y) {
  constexpr int kUnknown = 127;  // that of a log-odds of 0
  const std::string at = "x " + fixedText(x, 2) + " m, y " + fixedText(y, 2) + " m: ";
  const double column = std::floor((x - map.left) / map.resolution);
  const double row = std::floor((map.top() - y) / map.resolution);
  if (!(column >= 0 && column < map.width && row >= 0 && row < map.height)) return at + "unknown";
  const size_t pixel =
      static_cast<size_t>(row) * static_cast<size_t>(map.width) + static_cast<size_t>(column);
  const int grey = map.grey[pixel];
  return at + (grey == kUnknown ? "unknown" : "occupied " + fixedText(1 - grey / 255.0, 2));
}

MapImage mapImage(const mrpt::maps::COccupancyGridMap2D& grid) {
  constexpr int kMargin = 10, kMostPixels = 8192;
  const int width = static_cast<int>(grid.getSizeX()), height = static_cast<int>(grid.getSizeY());
  int x0 = width, y0 = height, x1 = -1, y1 = -1;  // bounds of the known cells, inclusive
  for (int y = 0; y < height; ++y) {
    const auto* row = grid.getRow(y);
    for (int x = 0; x < width; ++x)
      if (row[x] != 0) {
        x0 = std::min(x0, x);
        x1 = std::max(x1, x);
        y0 = std::min(y0, y);
        y1 = std::max(y1, y);
      }
  }
  MapImage image;
  if (x1 < 0) return image;
  x0 = std::max(x0 - kMargin, 0);
  y0 = std::max(y0 - kMargin, 0);
  x1 = std::min(x1 + kMargin, width - 1);
  y1 = std::min(y1 + kMargin, height - 1);

  const int cells = 1 + std::max(x1 - x0, y1 - y0) / kMostPixels;  // along the side of a pixel
  image.width = (x1 - x0) / cells + 1;
  image.height = (y1 - y0) / cells + 1;
  image.resolution = cells * static_cast<double>(grid.getResolution());
  image.left = grid.getXMin() + x0 * static_cast<double>(grid.getResolution());
  image.bottom = grid.getYMin() + y0 * static_cast<double>(grid.getResolution());
  image.grey.assign(static_cast<size_t>(image.width) * static_cast<size_t>(image.height), 255);
  for (int y = y0; y <= y1; ++y) {
    const auto* row = grid.getRow(y);
    uint8_t* const pixels = &image.grey[static_cast<size_t>(image.height - 1 - (y - y0) / cells) *
                                        static_cast<size_t>(image.width)];
    for (int x = x0; x <= x1; ++x) {
      uint8_t& pixel = pixels[(x - x0) / cells];
      pixel = std::min(pixel, mrpt::maps::COccupancyGridMap2D::l2p_255(row[x]));
    }
  }
  return image;
}

}  // namespace hybrid_slam::window
