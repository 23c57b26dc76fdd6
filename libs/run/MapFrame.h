/// @file MapFrame.h
/// @brief Frame of the map in its picture: coordinates, scale bar, legend.
#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace hybrid_slam::run {

/// Returns the largest number up to `most` (> 0) that is 1, 2 or 5 times a power of ten.
double roundNumber(double most);

/// An entry of the legend: draws its symbol into a rectangle of `width` x 1 times the text's height.
struct LegendItem {
  std::string label;
  double width = 2;  ///< of the symbol, in heights of the text
  std::function<void(cv::Mat& picture, const cv::Rect& symbol)> draw;
};

/// The part of the map frame that the picture shows.
struct MapArea {
  double left, top;  ///< m
  double pixelsPerMetre;
};

/// Thickness of a thin line in a picture whose longer side has `pixels`.
int thinLine(int pixels);

/// Draws lines at round coordinates, fainter than the cells.
void drawGrid(cv::Mat& map, const MapArea& area);

/// Draws the map in a frame with these coordinates, above a scale bar and the legend.
cv::Mat framed(const cv::Mat& map, const MapArea& area, std::vector<LegendItem> legend);

}  // namespace hybrid_slam::run
