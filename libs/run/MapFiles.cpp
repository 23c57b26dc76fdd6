#include "run/MapFiles.h"

#include <mrpt/img/CImage.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <opencv2/imgcodecs.hpp>

#include "files/RawlogWriter.h"
#include "slam/lines/LineTable.h"

namespace hybrid_slam::run {
namespace {

using mrpt::img::TColor;
using mrpt::maps::COccupancyGridMap2D;

/// Columns and rows with known cells, plus a margin; the whole grid if there are none.
struct Window {
  int x0, y0, x1, y1;  ///< both ends included
  int width() const { return x1 - x0 + 1; }
  int height() const { return y1 - y0 + 1; }
};

Window knownWindow(const COccupancyGridMap2D& grid) {
  constexpr int kMargin = 10;
  const int width = static_cast<int>(grid.getSizeX()), height = static_cast<int>(grid.getSizeY());
  Window known{width, height, -1, -1};
  for (int y = 0; y < height; ++y) {
    const auto* row = grid.getRow(y);
    for (int x = 0; x < width; ++x)
      if (row[x] != 0)
        known = {std::min(known.x0, x), std::min(known.y0, y), std::max(known.x1, x), std::max(known.y1, y)};
  }
  if (known.x1 < 0) return {0, 0, width - 1, height - 1};
  return {std::max(known.x0 - kMargin, 0), std::max(known.y0 - kMargin, 0),
          std::min(known.x1 + kMargin, width - 1), std::min(known.y1 + kMargin, height - 1)};
}

/// Cells along the side of a pixel, so that a picture has at most 2^26 pixels (RGB: 200 MB), 2^14 on a side.
int reductionOf(const Window& window) {
  constexpr double kMostPixels = 1 << 26, kLongestSide = 1 << 14;
  const double pixels = static_cast<double>(window.width()) * window.height();
  const double longest = std::max(window.width(), window.height());
  return static_cast<int>(
      std::ceil(std::max({1.0, std::sqrt(pixels / kMostPixels), longest / kLongestSide})));
}

/// Of a square of cells to the right of and below (x, y): thin walls remain visible in a reduced picture.
float leastFree(const COccupancyGridMap2D& grid, int x, int y, int side) {
  float least = 1;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) least = std::min(least, grid.getCell(x + i, y - j));
  return least;
}

}  // namespace

void savePicture(const files::OutputFolder& folder, const COccupancyGridMap2D& grid,
                 const files::Trajectory& trajectory, const std::vector<DatabaseLine>& lines,
                 const std::vector<DoubtfulPlace>& doubtful) {
  const Window window = knownWindow(grid);
  // Small maps are enlarged, so that path and lines do not hide the walls.
  const int enlarged = std::clamp(1600 / std::max(window.width(), window.height()), 1, 4);
  const int reduced = reductionOf(window);
  const int width = (window.width() * enlarged + reduced - 1) / reduced;
  const int height = (window.height() * enlarged + reduced - 1) / reduced;
  mrpt::img::CImage image(width, height, mrpt::img::CH_RGB);
  for (int y = 0; y < height; ++y) {
    uint8_t* pixel = image.asCvMatRef().ptr<uint8_t>(y);  // setPixel is much slower
    for (int x = 0; x < width; ++x, pixel += 3) {
      const float free =
          leastFree(grid, window.x0 + x * reduced / enlarged, window.y1 - y * reduced / enlarged, reduced);
      std::fill_n(pixel, 3, static_cast<uint8_t>(std::lround(255 * free)));
    }
  }

  const double scale = static_cast<double>(enlarged) / reduced;  // pixels per cell
  const auto column = [&](double x) {
    return static_cast<int>(std::lround(((x - grid.getXMin()) / grid.getResolution() - window.x0) * scale));
  };
  const auto row = [&](double y) {
    return static_cast<int>(
        std::lround((window.y1 + 1 - (y - grid.getYMin()) / grid.getResolution()) * scale));
  };
  for (const DatabaseLine& line : lines)
    image.line(column(line.start.x), row(line.start.y), column(line.end.x), row(line.end.y),
               TColor(0, 160, 0), 2);
  for (size_t i = 1; i < trajectory.size(); ++i) {
    const auto &a = trajectory[i - 1].pose, &b = trajectory[i].pose;
    image.line(column(a.x), row(a.y), column(b.x), row(b.y), TColor(220, 0, 0), 1);
  }
  if (!trajectory.empty()) {
    const auto& robot = trajectory.back().pose;
    const int radius = std::max(4, static_cast<int>(std::lround(0.25 / grid.getResolution() * scale)));
    const TColor lightBlue(80, 180, 255);
    image.drawCircle(column(robot.x), row(robot.y), radius, lightBlue, 2);
    image.line(column(robot.x), row(robot.y),
               column(robot.x) + static_cast<int>(std::lround(radius * std::cos(robot.phi))),
               row(robot.y) - static_cast<int>(std::lround(radius * std::sin(robot.phi))), lightBlue, 2);
  }
  for (const DoubtfulPlace& place : doubtful) {
    const double metres = 1 + place.length / 2;
    const int radius = static_cast<int>(std::lround(std::min(metres, 5.0) / grid.getResolution() * scale));
    image.drawCircle(column(place.at.x), row(place.at.y), radius, TColor(255, 140, 0), 3);
  }
  // Encoded in memory: libpng would print a full disk to standard error itself.
  std::vector<unsigned char> png;
  cv::imencode(".png", image.asCvMatRef(), png);
  folder.write("map.png", [&png](std::ostream& out) {
    out.write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
  });
}

void saveRosMap(const files::OutputFolder& folder, const COccupancyGridMap2D& grid) {
  // About ten crossing beams make a cell free; the YAML thresholds match the grey values.
  constexpr double kOccupied = 0.65, kFree = 0.35;
  const Window window = knownWindow(grid);
  folder.write("map.pgm", [&](std::ostream& out) {
    out << "P5\n" << window.width() << " " << window.height() << "\n255\n";
    std::string row;
    for (int y = window.y1; y >= window.y0; --y, row.clear()) {
      for (int x = window.x0; x <= window.x1; ++x) {
        const float occupied = 1 - grid.getCell(x, y);
        row += static_cast<char>(occupied > kOccupied ? 0 : occupied < kFree ? 254 : 205);
      }
      out << row;
    }
  });
  const auto rounded = [](double metres) { return std::round(metres * 1e5) / 1e5; };  // MRPT uses floats
  const double cell = grid.getResolution();
  folder.write("map.yaml", [&](std::ostream& out) {
    out << std::setprecision(10) << "image: map.pgm\nresolution: " << rounded(cell) << "\norigin: ["
        << rounded(grid.getXMin() + window.x0 * cell) << ", " << rounded(grid.getYMin() + window.y0 * cell)
        << ", 0.0]\nnegate: 0\noccupied_thresh: " << kOccupied << "\nfree_thresh: 0.196\n";
  });
}

void saveGridMap(const files::OutputFolder& folder, const COccupancyGridMap2D& grid) {
  files::RawlogWriter file(folder.path("map.gridmap.gz"));
  file.write(grid);
  file.finish();
}

void saveLines(const files::OutputFolder& folder, const std::vector<DatabaseLine>& lines) {
  folder.write("lines.csv", [&lines](std::ostream& out) { writeLineTable(lines, out); });
}

}  // namespace hybrid_slam::run
