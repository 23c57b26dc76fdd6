#include "window/view/SceneLegend.h"

#include <utility>

#include "base/Numbers.h"
#include "run/MapFrame.h"
#include "window/view/SceneStrokes.h"

namespace hybrid_slam::window {

using Symbol = LegendEntry::Symbol;
using mrpt::math::TPoint2D;

namespace {

/// Sizes in pixels. The scale bar is the first item of the first row.
constexpr double kRow = 15, kMargin = 8, kPadding = 3, kSymbol = 14, kGap = 4, kBetween = 12;
constexpr double kLongestBar = 80, kBarWithLabel = 140;
constexpr int kFont = 9;

/// Approximate width of a text; CText::computeTextExtension does not give pixels.
double widthOf(const std::string& text) { return 7 * static_cast<double>(text.size()); }

LegendLayout inRows(std::vector<LegendEntry> entries, PictureSize size) {
  LegendLayout layout;
  layout.entries = std::move(entries);
  double x = kMargin + kBarWithLabel, y = kPadding;
  for (const LegendEntry& entry : layout.entries) {
    const double width = kSymbol + kGap + widthOf(entry.label);
    if (x + width > size.width) x = kMargin, y += kRow;
    layout.places.emplace_back(x, y);
    x += width + kBetween;
  }
  layout.height = y + kRow + kPadding;
  return layout;
}

/// Draws in pixel coordinates of the strip.
class LegendPainter {
 public:
  LegendPainter(mrpt::opengl::COpenGLScene& scene, const MapView& view, PictureSize size, double top,
                double above, double density)
      : scene_(scene), view_(view), size_(size), top_(top), height_(above), density_(density) {}

  void background() {
    strokes("legend", colours::kGrey, 1)
        .rectangle(at(0, 0), at(static_cast<double>(size_.width), size_.height - top_));
  }
  void scaleBar() {
    const double metres = scaleBarLength(view_.scale), length = metres * view_.scale;
    const double y = kPadding + kRow - 5, left = kMargin, right = kMargin + length;
    Strokes bar = strokes("scale bar", colours::kWhite, 2);
    bar.segment(at(left, y), at(right, y));
    for (const double end : {left, right}) bar.segment(at(end, y), at(end, y - 5));
    text(right + kGap + 2, kPadding, numberText(metres) + " m");
  }
  void entry(const LegendEntry& entry, const TPoint2D& place) {
    const double middle = place.y + kRow / 2, pixel = 1 / view_.scale;
    const TPoint2D left = at(place.x, middle), right = at(place.x + kSymbol, middle);
    const TPoint2D centre = at(place.x + kSymbol / 2, middle);
    Strokes all = strokes("legend entry", entry.colour, entry.symbol == Symbol::stroke ? 3 : 2);
    if (entry.symbol == Symbol::stroke) all.segment(left, right);
    if (entry.symbol == Symbol::arrow) all.arrow(centre, 0, 7 * pixel);
    if (entry.symbol == Symbol::ellipse) all.ellipse(centre, 6 * pixel, 4 * pixel, 0);
    if (entry.symbol == Symbol::area)
      all.rectangle(at(place.x + 1, middle - 5), at(place.x + 13, middle + 5));
    if (entry.symbol == Symbol::circle) {
      all.ellipse(centre, 5 * pixel, 5 * pixel, 0);
      all.segment(centre, ahead(centre, 0, 5 * pixel));
    }
    text(place.x + kSymbol + kGap, place.y, entry.label);
  }

 private:
  TPoint2D at(double x, double y) const { return view_.toMap(x, top_ + y, size_); }
  Strokes strokes(const char* name, const mrpt::img::TColor& colour, double width) {
    height_ += 1 / view_.scale;
    Strokes added(name, colour, width / view_.scale, height_);
    scene_.insert(added.object());
    return added;
  }
  /// Draws a label in a row with this upper edge.
  void text(double x, double y, const std::string& label) {
    constexpr size_t kFirstId = 100;  // the caption has the lower ones
    mrpt::opengl::TFontParams font;
    font.vfont_name = "sans";
    font.vfont_scale = static_cast<float>(kFont * density_);
    scene_.getViewport()->addTextMessage(x * density_, (size_.height - top_ - y - kRow + 3) * density_, label,
                                         kFirstId + texts_++, font);
  }

  mrpt::opengl::COpenGLScene& scene_;
  MapView view_;
  PictureSize size_;
  double top_, height_, density_;
  size_t texts_ = 0;
};

}  // namespace

std::vector<LegendEntry> legendOf(const FilterSnapshot& filter, const Layers& layers) {
  using namespace colours;
  std::vector<LegendEntry> entries;
  const auto add = [&](bool isDrawn, const char* label, const mrpt::img::TColor& colour, Symbol symbol) {
    if (isDrawn) entries.push_back({label, colour, symbol});
  };
  const bool isPlaceKnown = !filter.place || filter.place->isKnown;
  add(filter.map.width > 0, "occupied", kBlack, Symbol::area);
  add(filter.map.width > 0, "free", kWhite, Symbol::area);
  add(layers.path && filter.path.size() > 1, "path", kRed, Symbol::stroke);
  add(layers.particles && !filter.particles.empty(), "particles", kRed, Symbol::arrow);
  add(!filter.path.empty(), "robot", kLightBlue, Symbol::circle);
  add(layers.ellipse && isPlaceKnown, "3 sigma", kViolet, Symbol::ellipse);
  add(layers.lines && !filter.lines.empty(), "lines", kGreen, Symbol::stroke);
  add(layers.scanLines && !filter.scanLines.empty(), "matched", kBlue, Symbol::stroke);
  add(layers.scanLines && !filter.scanLines.empty(), "unmatched", kOrange, Symbol::stroke);
  return entries;
}

double scaleBarLength(double scale) { return run::roundNumber(kLongestBar / scale); }

LegendLayout legendLayout(const FilterSnapshot& filter, const Layers& layers, PictureSize size) {
  return layers.legend ? inRows(legendOf(filter, layers), size) : LegendLayout();
}

double legendRoom(const Layers& layers, PictureSize size) {
  FilterSnapshot filter;
  filter.map.width = 1;
  filter.path.resize(2);
  filter.particles.resize(1);
  filter.lines.resize(1);
  filter.scanLines.resize(1);
  return legendLayout(filter, layers, size).height;
}

void addLegend(mrpt::opengl::COpenGLScene& scene, const LegendLayout& layout, const MapView& view,
               PictureSize size, double above, double density) {
  if (layout.height == 0) return;
  LegendPainter painter(scene, view, size, size.height - layout.height, above, density);
  painter.background();
  painter.scaleBar();
  for (size_t i = 0; i < layout.entries.size(); ++i) painter.entry(layout.entries[i], layout.places[i]);
}

}  // namespace hybrid_slam::window
