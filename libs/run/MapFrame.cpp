#include "run/MapFrame.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/Numbers.h"

namespace hybrid_slam::run {
namespace {

const cv::Scalar kInk(60, 60, 60);

/// Returns the line height of the text in a picture whose longer side has `longest` pixels.
int emOf(int longest) { return std::clamp(longest / 64, 12, 100); }

/// Draws text whose size is proportional to the picture's.
class Text {
 public:
  explicit Text(const cv::Mat& map) : em_(emOf(std::max(map.cols, map.rows))) {}
  int em() const { return em_; }  ///< line height, pixels
  int widthOf(const std::string& text) const {
    int below = 0;
    return cv::getTextSize(text, kFont, scale(), thickness(), &below).width;
  }
  /// Draws text vertically centred on y.
  void draw(cv::Mat& picture, const std::string& text, int left, int y) const {
    int below = 0;
    const int height = cv::getTextSize(text, kFont, scale(), thickness(), &below).height;
    cv::putText(picture, text, {left, y + height / 2}, kFont, scale(), kInk, thickness(), cv::LINE_AA);
  }

 private:
  static constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
  double scale() const { return em_ * 0.031; }  // capitals of two thirds of a line
  int thickness() const { return std::max(1, em_ / 14); }
  int em_;
};

std::string metres(double value) { return numberText(value) + " m"; }

struct Tick {
  double value;  ///< m
  int pixel;     ///< of the map
};

/// Round coordinates, about six per side of the picture; fewer in a small one, so that their labels fit.
std::vector<Tick> ticks(double first, double direction, int pixels, int longest, double pixelsPerMetre) {
  const double least = 5 * emOf(longest) / pixelsPerMetre;
  double step = roundNumber(longest / 4.9 / pixelsPerMetre);
  while (step < least) step = roundNumber(3 * step);
  const double last = first + direction * pixels / pixelsPerMetre;
  std::vector<Tick> all;
  for (double k = std::ceil(std::min(first, last) / step); k * step <= std::max(first, last); ++k) {
    const double value = k == 0 ? 0 : k * step;
    const int pixel = static_cast<int>(std::floor((value - first) * direction * pixelsPerMetre));
    if (pixel >= 0 && pixel < pixels) all.push_back({value, pixel});
  }
  return all;
}

std::vector<Tick> columns(const cv::Mat& map, const MapArea& area) {
  return ticks(area.left, 1, map.cols, std::max(map.cols, map.rows), area.pixelsPerMetre);
}

std::vector<Tick> rows(const cv::Mat& map, const MapArea& area) {
  return ticks(area.top, -1, map.rows, std::max(map.cols, map.rows), area.pixelsPerMetre);
}

LegendItem scaleBar(const cv::Mat& map, const MapArea& area, int em) {
  const double length = roundNumber(std::max(map.cols, map.rows) / 6. / area.pixelsPerMetre);
  const int pixels = std::max(1, static_cast<int>(std::lround(length * area.pixelsPerMetre)));
  const auto draw = [pixels, em](cv::Mat& picture, const cv::Rect& symbol) {
    const int thick = std::max(1, em / 8), y = symbol.y + symbol.height * 3 / 4;
    cv::rectangle(picture, cv::Rect(symbol.x, y - thick, pixels, thick), cv::Scalar(0, 0, 0), cv::FILLED);
    for (const int x : {symbol.x, symbol.x + pixels - thick})
      cv::rectangle(picture, cv::Rect(x, y - em / 2, thick, em / 2), cv::Scalar(0, 0, 0), cv::FILLED);
  };
  return {metres(length), static_cast<double>(pixels) / em, draw};
}

/// Places the entries side by side, in as many rows as needed.
std::vector<cv::Point> legendPlaces(const std::vector<LegendItem>& legend, const Text& text, int width) {
  const int em = text.em();
  std::vector<cv::Point> places;
  cv::Point next(0, 0);
  for (const LegendItem& entry : legend) {
    const int needed = static_cast<int>(entry.width * em) + em / 2 + text.widthOf(entry.label);
    if (next.x > 0 && next.x + needed > width) next = {0, next.y + 2 * em};
    places.push_back(next);
    next.x += needed + 3 * em / 2;
  }
  return places;
}

}  // namespace

double roundNumber(double most) {
  const double power = std::pow(10, std::floor(std::log10(most)));
  return power * (most >= 5 * power ? 5 : most >= 2 * power ? 2 : 1);
}

int thinLine(int pixels) { return std::max(1, (pixels + 450) / 900); }

void drawGrid(cv::Mat& map, const MapArea& area) {
  constexpr double kFaint = 0.9;
  for (const Tick& tick : columns(map, area)) map.col(tick.pixel) *= kFaint;
  for (const Tick& tick : rows(map, area)) map.row(tick.pixel) *= kFaint;
}

cv::Mat framed(const cv::Mat& map, const MapArea& area, std::vector<LegendItem> legend) {
  const Text text(map);
  const int em = text.em();
  legend.insert(legend.begin(), scaleBar(map, area, em));
  int left = 2 * em;
  for (const Tick& tick : rows(map, area)) left = std::max(left, text.widthOf(metres(tick.value)) + 2 * em);
  const int top = em, right = 2 * em, below = top + map.rows + 3 * em;

  const std::vector<cv::Point> places = legendPlaces(legend, text, map.cols);
  int width = left + map.cols;
  for (const auto& entry : legend)
    width = std::max(width, left + static_cast<int>(entry.width * em) + em / 2 + text.widthOf(entry.label));
  cv::Mat picture(below + places.back().y + 2 * em, width + right, CV_8UC3, cv::Scalar(255, 255, 255));

  const int thin = thinLine(std::max(map.cols, map.rows));
  picture(cv::Rect(left - thin, top - thin, map.cols + 2 * thin, map.rows + 2 * thin)) = kInk;
  map.copyTo(picture(cv::Rect(left, top, map.cols, map.rows)));
  for (const Tick& tick : columns(map, area)) {
    const std::string label = metres(tick.value);
    const int x = left + tick.pixel, y = top + map.rows;
    cv::line(picture, {x, y}, {x, y + em / 3}, kInk, thin);
    text.draw(picture, label, x - text.widthOf(label) / 2, y + em);
  }
  for (const Tick& tick : rows(map, area)) {
    const std::string label = metres(tick.value);
    const int y = top + tick.pixel;
    cv::line(picture, {left - em / 3, y}, {left, y}, kInk, thin);
    text.draw(picture, label, left - em - text.widthOf(label), y);
  }
  for (size_t i = 0; i < legend.size(); ++i) {
    const int symbolWidth = static_cast<int>(legend[i].width * em);
    const cv::Rect symbol(left + places[i].x, below + places[i].y, symbolWidth, em);
    legend[i].draw(picture, symbol);
    text.draw(picture, legend[i].label, symbol.x + symbolWidth + em / 2, symbol.y + em / 2);
  }
  return picture;
}

}  // namespace hybrid_slam::run
