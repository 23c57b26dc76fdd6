#include "gui/FilterDrawing.h"

#include <wx/dcmemory.h>
#include <wx/image.h>
#include <wx/settings.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace hybrid_slam {
namespace {

const wxColour kUnknown(127, 127, 127), kRed(220, 0, 0), kGreen(0, 150, 0), kBlue(0, 70, 230),
    kOrange(245, 130, 0), kViolet(150, 0, 180), kLightBlue(80, 180, 255);

class FilterPainter {
 public:
  FilterPainter(wxGraphicsContext& to, const wxSize& size, const FilterSnapshot& filter, const MapView& view)
      : to_(to), size_(size), filter_(filter), view_(view) {}

  void grid(const wxBitmap& bitmap) {
    to_.SetBrush(wxBrush(kUnknown));
    to_.SetPen(*wxTRANSPARENT_PEN);
    to_.DrawRectangle(0, 0, size_.x, size_.y);
    if (!bitmap.IsOk()) return;
    const MapImage& map = filter_.map;
    const auto corner = view_.toPicture(map.left, map.top(), size_);
    const double pixels = view_.scale * map.resolution;
    to_.SetInterpolationQuality(pixels < 1 ? wxINTERPOLATION_DEFAULT : wxINTERPOLATION_NONE);
    to_.DrawBitmap(bitmap, corner.m_x, corner.m_y, map.width * pixels, map.height * pixels);
  }

  void path() {
    if (filter_.path.size() < 2) return;
    wxGraphicsPath line = to_.CreatePath();
    line.MoveToPoint(place(filter_.path.front().x, filter_.path.front().y));
    for (const auto& pose : filter_.path) line.AddLineToPoint(place(pose.x, pose.y));
    to_.SetPen(wxPen(kRed, 1));
    to_.StrokePath(line);
  }

  void particles() {
    to_.SetPen(wxPen(kRed, 1));
    for (const auto& particle : filter_.particles) {
      const auto at = place(particle.pose.x, particle.pose.y);
      to_.StrokeLine(at.m_x, at.m_y, at.m_x + 7 * std::cos(particle.pose.phi),
                     at.m_y - 7 * std::sin(particle.pose.phi));
      to_.SetBrush(wxBrush(kRed));
      to_.DrawEllipse(at.m_x - 1.5, at.m_y - 1.5, 3, 3);
    }
  }

  void lines() {
    for (const DatabaseLine& line : filter_.lines) segment(line, kGreen, 2);
  }

  void scanLines() {
    for (const ScanLine& line : filter_.scanLines)
      segment(line.segment, line.isMatched ? kBlue : kOrange, 3);
  }

  void ellipse() {
    constexpr double kSigmas = 3;
    const UncertaintyEllipse& e = filter_.ellipse;
    const auto centre = place(e.centre.x, e.centre.y);
    to_.PushState();
    to_.Translate(centre.m_x, centre.m_y);
    to_.Rotate(-e.direction);
    const double a = std::max(kSigmas * e.major * view_.scale, 2.0),
                 b = std::max(kSigmas * e.minor * view_.scale, 2.0);
    to_.SetBrush(*wxTRANSPARENT_BRUSH);
    to_.SetPen(wxPen(kViolet, 2));
    to_.DrawEllipse(-a, -b, 2 * a, 2 * b);
    to_.PopState();
  }

  void robot() {
    if (filter_.path.empty()) return;
    const auto& pose = filter_.path.back();
    const auto at = place(pose.x, pose.y);
    const double radius = std::max(6.0, 0.25 * view_.scale);
    to_.SetBrush(*wxTRANSPARENT_BRUSH);
    to_.SetPen(wxPen(kLightBlue, 3));
    to_.DrawEllipse(at.m_x - radius, at.m_y - radius, 2 * radius, 2 * radius);
    to_.StrokeLine(at.m_x, at.m_y, at.m_x + radius * std::cos(pose.phi), at.m_y - radius * std::sin(pose.phi));
  }

  /// A compass in the upper right corner: the two dominating directions.
  void dominatingDirection() {
    if (!filter_.dominatingDirection) return;
    const double x = size_.x - 34, y = 34, radius = 24;
    to_.SetBrush(wxBrush(wxColour(255, 255, 255, 200)));
    to_.SetPen(*wxTRANSPARENT_PEN);
    to_.DrawEllipse(x - radius - 4, y - radius - 4, 2 * radius + 8, 2 * radius + 8);
    for (const double turn : {0.0, M_PI / 2}) {
      const double angle = *filter_.dominatingDirection + turn;
      const double dx = radius * std::cos(angle), dy = -radius * std::sin(angle);
      to_.SetPen(wxPen(kGreen, turn == 0 ? 3 : 1));
      to_.StrokeLine(x - dx, y - dy, x + dx, y + dy);
    }
  }

  void caption() {
    wxString text = wxString::Format("%s: %zu updates, ESS %.0f %%", filter_.method, filter_.updates,
                                     100 * filter_.step.ess);
    if (!filter_.lines.empty() || !filter_.scanLines.empty())
      text += wxString::Format(", %zu lines, %d of %d matched", filter_.lines.size(),
                               filter_.step.linesMatched, filter_.step.linesSeen);
    to_.SetFont(wxSystemSettings::GetFont(wxSYS_DEFAULT_GUI_FONT), *wxBLACK);
    double width = 0, height = 0;
    to_.GetTextExtent(text, &width, &height);
    to_.SetBrush(wxBrush(wxColour(255, 255, 255, 210)));
    to_.SetPen(*wxTRANSPARENT_PEN);
    to_.DrawRectangle(4, 4, width + 8, height + 4);
    to_.DrawText(text, 8, 6);
  }

 private:
  wxPoint2DDouble place(double x, double y) const { return view_.toPicture(x, y, size_); }
  void segment(const LineSegment& line, const wxColour& colour, int width) {
    const auto a = place(line.start.x, line.start.y), b = place(line.end.x, line.end.y);
    to_.SetPen(wxPen(colour, width));
    to_.StrokeLine(a.m_x, a.m_y, b.m_x, b.m_y);
  }

  wxGraphicsContext& to_;
  wxSize size_;
  const FilterSnapshot& filter_;
  MapView view_;
};

}  // namespace

MapView wholeMap(const MapImage& map, const wxSize& size) {
  MapView view;
  if (map.width == 0) return view;
  view.centreX = (map.left + map.right()) / 2;
  view.centreY = (map.bottom + map.top()) / 2;
  const double free = std::max(size.y - 60, 1);  // the caption above, and as much below
  view.scale = std::min(size.x / (map.right() - map.left), free / (map.top() - map.bottom));
  view.scale = std::max(view.scale, 0.01);
  return view;
}

wxBitmap mapBitmap(const MapImage& map) {
  if (map.width == 0) return {};
  wxImage image(map.width, map.height, false);
  unsigned char* to = image.GetData();
  for (const uint8_t grey : map.grey) {
    *to++ = grey;
    *to++ = grey;
    *to++ = grey;
  }
  return wxBitmap(image);
}

void drawFilter(wxGraphicsContext& to, const wxSize& size, const FilterSnapshot& filter, const wxBitmap& map,
                const MapView& view, const Layers& layers) {
  FilterPainter painter(to, size, filter, view);
  painter.grid(map);
  if (layers.lines) painter.lines();
  if (layers.path) painter.path();
  if (layers.scanLines) painter.scanLines();
  if (layers.particles) painter.particles();
  if (layers.ellipse) painter.ellipse();
  painter.robot();
  if (layers.lines) painter.dominatingDirection();
  painter.caption();
}

wxBitmap pictureOf(const FilterSnapshot& filter, const wxSize& size, const Layers& layers) {
  wxBitmap picture(size.x, size.y, 24);
  wxMemoryDC dc(picture);
  const std::unique_ptr<wxGraphicsContext> to(wxGraphicsContext::Create(dc));
  drawFilter(*to, size, filter, mapBitmap(filter.map), wholeMap(filter.map, size), layers);
  return picture;
}

}  // namespace hybrid_slam
