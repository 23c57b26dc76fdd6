#include "window/view/FilterScene.h"

#include <mrpt/core/format.h>
#include <mrpt/opengl/CFBORender.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "window/view/SceneLegend.h"
#include "window/view/SceneStrokes.h"

namespace hybrid_slam::window {

using namespace colours;

using mrpt::math::TPoint2D;
using mrpt::opengl::COpenGLScene;
using mrpt::opengl::COpenGLViewport;
using mrpt::opengl::CTexturedPlane;

namespace {

/// Sets a view from above, without perspective, in which a viewport of `size` shows `scale` pixels per m.
void lookDown(COpenGLViewport& viewport, double x, double y, double scale, PictureSize size) {
  // MRPT's orthogonal camera shows half its distance across the shorter side.
  const double distance = 2 * std::min(size.width, size.height) / scale;
  auto& camera = viewport.getCamera();
  camera.setOrthogonal(true);
  camera.setAzimuthDegrees(-90);
  camera.setElevationDegrees(90);
  camera.setPointingAt(mrpt::math::TPoint3D(x, y, 0));
  camera.setZoomDistance(static_cast<float>(distance));
  viewport.setViewportClipDistances(0.01f * static_cast<float>(distance), 2 * static_cast<float>(distance));
}

class ScenePainter {
 public:
  ScenePainter(const FilterSnapshot& filter, const MapView& view, PictureSize size, double density)
      : filter_(filter), pixel_(1 / view.scale), density_(density), size_(size), view_(view) {
    main_ = scene_->getViewport();
    main_->setCustomBackgroundColor({0.5f, 0.5f, 0.5f});
    lookDown(*main_, view.centreX, view.centreY, view.scale, size);
  }

  void grid(const CTexturedPlane::Ptr& plane) {
    if (plane) scene_->insert(plane);
  }
  void lines() {
    Strokes all = strokes("lines", kGreen, 2);
    for (const DatabaseLine& line : filter_.lines) all.segment(line.start, line.end);
  }
  void path() {
    Strokes all = strokes("path", kRed, 1);
    for (size_t i = 1; i < filter_.path.size(); ++i)
      all.segment(TPoint2D(filter_.path[i - 1]), TPoint2D(filter_.path[i]));
  }
  void scanLines() {
    Strokes matched = strokes("scan lines, matched", kBlue, 3),
            others = strokes("scan lines, not matched", kOrange, 3);
    for (const ScanLine& line : filter_.scanLines)
      (line.isMatched ? matched : others).segment(line.segment.start, line.segment.end);
  }
  void particles() {
    Strokes all = strokes("particles", kRed, 1);
    for (const auto& particle : filter_.particles)
      all.arrow(TPoint2D(particle.pose), particle.pose.phi, 7 * pixel_);
  }
  void ellipse() {
    if (!isPlaceKnown()) return;
    constexpr double kSigmas = 3;
    const UncertaintyEllipse& e = filter_.ellipse;
    strokes("uncertainty", kViolet, 2)
        .ellipse(e.centre, std::max(kSigmas * e.major, 2 * pixel_), std::max(kSigmas * e.minor, 2 * pixel_),
                 e.direction);
  }
  void robot() {
    if (filter_.path.empty()) return;
    const auto& pose = filter_.path.back();
    const double radius = std::max(6 * pixel_, 0.25);
    Strokes all = strokes("robot", kLightBlue, 3);
    all.ellipse(TPoint2D(pose), radius, radius, 0);
    all.segment(TPoint2D(pose), ahead(TPoint2D(pose), pose.phi, radius));
  }
  /// Draws a compass in the upper right corner: the two dominating directions.
  void dominatingDirection() {
    if (!filter_.dominatingDirection) return;
    const double radius = 24 * pixel_;
    const TPoint2D at = view_.toMap(size_.width - 34.0, 34, size_);
    strokes("compass", kWhite, 1).ellipse(at, radius + 3 * pixel_, radius + 3 * pixel_, 0);
    for (const double turn : {0.0, M_PI / 2})
      strokes("dominating direction", kGreen, turn == 0 ? 3 : 1)
          .segment(ahead(at, *filter_.dominatingDirection + turn, -radius),
                   ahead(at, *filter_.dominatingDirection + turn, radius));
  }
  void caption() {
    mrpt::opengl::TFontParams font;
    font.vfont_name = "sans";
    font.vfont_scale = static_cast<float>(11 * density_);
    font.color = {1, 1, 1};
    font.draw_shadow = true;
    font.shadow_color = {0, 0, 0};
    size_t line = 0;
    for (const std::string& text : captionOf(filter_)) {
      main_->addTextMessage(8 * density_, -18 * static_cast<double>(line + 1) * density_, text, line, font);
      ++line;
    }
  }
  void legend(const Layers& layers) {
    addLegend(*scene_, legendLayout(filter_, layers, size_), view_, size_, height_, density_);
  }
  const COpenGLScene::Ptr& scene() const { return scene_; }

 private:
  bool isPlaceKnown() const { return !filter_.place || filter_.place->isKnown; }
  /// Adds a layer above the previous ones. @param width  pixels
  Strokes strokes(const char* name, const mrpt::img::TColor& colour, double width) {
    height_ += pixel_;
    const Strokes added(name, colour, width * pixel_, height_);
    scene_->insert(added.object());
    return added;
  }

  const FilterSnapshot& filter_;
  double pixel_;  ///< m
  double density_;
  PictureSize size_;
  MapView view_;
  double height_ = 0;  ///< m
  COpenGLScene::Ptr scene_ = COpenGLScene::Create();
  COpenGLViewport::Ptr main_;
};

}  // namespace

std::vector<std::string> captionOf(const FilterSnapshot& filter) {
  std::vector<std::string> lines{mrpt::format("%s: %zu updates", filter.method.c_str(), filter.updates)};
  if (filter.place) lines.push_back(describe(*filter.place));
  if (filter.place && !filter.place->isKnown) return lines;
  lines[0] += mrpt::format(", ESS %.0f %%", 100 * filter.step.ess);
  const auto matched = std::count_if(filter.scanLines.begin(), filter.scanLines.end(),
                                     [](const ScanLine& line) { return line.isMatched; });
  if (!filter.lines.empty() || !filter.scanLines.empty())
    lines.push_back(mrpt::format("%zu lines; of the scan: %zu of %zu match", filter.lines.size(),
                                 static_cast<size_t>(matched), filter.scanLines.size()));
  if (filter.verdict) lines.push_back("so far " + filter.verdict->name());
  return lines;
}

MapView wholeMap(const MapImage& map, const Layers& layers, PictureSize size) {
  MapView view;
  if (map.width == 0) return view;
  constexpr double kAbove = 60, kMargin = 6;  // pixels: the caption; beside the legend
  const double below = legendRoom(layers, size) + kMargin;
  const double free = std::max(size.height - kAbove - below, 1.0);
  view.scale = std::min(size.width / (map.right() - map.left), free / (map.top() - map.bottom));
  view.scale = std::max(view.scale, 0.01);
  view.centreX = (map.left + map.right()) / 2;
  view.centreY = (map.bottom + map.top()) / 2 + (kAbove - below) / 2 / view.scale;
  return view;
}

CTexturedPlane::Ptr mapPlane(const MapImage& map) {
  if (map.width == 0) return nullptr;
  mrpt::img::CImage image(static_cast<unsigned>(map.width), static_cast<unsigned>(map.height),
                          mrpt::img::CH_RGB);
  for (int y = 0; y < map.height; ++y) {
    const uint8_t* const row = &map.grey[static_cast<size_t>(
        (map.height - 1 - y) * map.width)];  // a plane's first row is the lowest
    uint8_t* to = image.ptrLine<uint8_t>(static_cast<unsigned>(y));
    for (int x = 0; x < map.width; ++x) to = std::fill_n(to, 3, row[x]);
  }
  auto plane = CTexturedPlane::Create();
  plane->setName("grid");
  plane->setPlaneCorners(static_cast<float>(map.left), static_cast<float>(map.right()),
                         static_cast<float>(map.bottom), static_cast<float>(map.top()));
  plane->assignImage(image);
  plane->enableTextureLinearInterpolation(false);
  return plane;
}

COpenGLScene::Ptr filterScene(const FilterSnapshot& filter, const CTexturedPlane::Ptr& map,
                              const MapView& view, const Layers& layers, PictureSize size, double density) {
  ScenePainter painter(filter, view, size, density);
  painter.grid(map);
  if (layers.lines) painter.lines();
  if (layers.path) painter.path();
  if (layers.scanLines) painter.scanLines();
  painter.robot();
  if (layers.ellipse) painter.ellipse();
  if (layers.particles) painter.particles();
  if (layers.lines) painter.dominatingDirection();
  painter.caption();
  painter.legend(layers);
  return painter.scene();
}

mrpt::img::CImage pictureOf(const FilterSnapshot& filter, PictureSize size, const Layers& layers) {
  // OpenGL pads each row to a multiple of four bytes, for which MRPT's image has no room: at other widths it
  // would write past the end.
  const PictureSize rendered{(size.width + 3) / 4 * 4, size.height};
  MapView view = wholeMap(filter.map, layers, size);
  // What is cut off afterwards is on the right.
  view.centreX += (rendered.width - size.width) / 2.0 / view.scale;
  const auto scene = filterScene(filter, mapPlane(filter.map), view, layers, rendered);
  mrpt::opengl::CFBORender renderer(static_cast<unsigned>(rendered.width),
                                    static_cast<unsigned>(rendered.height));
  renderer.setCamera(*scene, scene->getViewport()->getCamera());
  mrpt::img::CImage all, picture;
  renderer.render_RGB(*scene, all);
  all.extract_patch(picture, 0, 0, static_cast<unsigned>(size.width), static_cast<unsigned>(size.height));
  return picture;
}

}  // namespace hybrid_slam::window
