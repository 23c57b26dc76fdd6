#include "gui/MapCanvas.h"

#include <wx/dcbuffer.h>

#include <algorithm>
#include <cmath>

namespace hybrid_slam {

MapCanvas::MapCanvas(wxWindow* parent, const wxString& title, std::shared_ptr<SharedView> shared,
                     std::function<void()> onChange)
    : wxPanel(parent, wxID_ANY, wxDefaultPosition, wxDefaultSize, wxFULL_REPAINT_ON_RESIZE),
      title_(title),
      shared_(std::move(shared)),
      onChange_(std::move(onChange)) {
  SetBackgroundStyle(wxBG_STYLE_PAINT);
  SetMinSize(FromDIP(wxSize(200, 200)));
  Bind(wxEVT_PAINT, &MapCanvas::onPaint, this);
  Bind(wxEVT_MOUSEWHEEL, &MapCanvas::onWheel, this);
  Bind(wxEVT_MOTION, &MapCanvas::onMotion, this);
  Bind(wxEVT_LEFT_DOWN, [this](wxMouseEvent& event) {
    lastMouse_ = event.GetPosition();
    event.Skip();
  });
  Bind(wxEVT_LEFT_DCLICK, [this](wxMouseEvent&) {
    shared_->fixed.reset();
    onChange_();
  });
}

void MapCanvas::show(const std::shared_ptr<const FilterSnapshot>& filter) {
  if (filter == filter_) return;
  filter_ = filter;
  map_ = filter ? mapBitmap(filter->map) : wxBitmap();
  Refresh(false);
}

MapView MapCanvas::view() const {
  if (shared_->fixed) return *shared_->fixed;
  return filter_ ? wholeMap(filter_->map, GetClientSize()) : MapView();
}

void MapCanvas::zoom(double factor) {
  zoomAt({GetClientSize().x / 2, GetClientSize().y / 2}, factor);
}

/// The place under the mouse stays there.
void MapCanvas::zoomAt(const wxPoint& at, double factor) {
  MapView next = view();
  const auto before = next.toMap(at, GetClientSize());
  next.scale = std::clamp(next.scale * factor, 0.1, 2000.0);
  const auto after = next.toMap(at, GetClientSize());
  next.centreX += before.m_x - after.m_x;
  next.centreY += before.m_y - after.m_y;
  shared_->fixed = next;
  onChange_();
}

void MapCanvas::onWheel(wxMouseEvent& event) {
  zoomAt(event.GetPosition(), std::pow(1.2, event.GetWheelRotation() / double(event.GetWheelDelta())));
}

void MapCanvas::onMotion(wxMouseEvent& event) {
  if (!event.Dragging() || !event.LeftIsDown()) return;
  MapView next = view();
  next.centreX -= (event.GetX() - lastMouse_.x) / next.scale;
  next.centreY += (event.GetY() - lastMouse_.y) / next.scale;
  lastMouse_ = event.GetPosition();
  shared_->fixed = next;
  onChange_();
}

void MapCanvas::onPaint(wxPaintEvent&) {
  wxAutoBufferedPaintDC dc(this);
  if (!filter_) {
    dc.SetBackground(wxBrush(wxColour(127, 127, 127)));
    dc.Clear();
    dc.SetTextForeground(*wxWHITE);
    dc.DrawLabel(title_, GetClientRect(), wxALIGN_CENTRE);
    return;
  }
  const std::unique_ptr<wxGraphicsContext> to(wxGraphicsContext::Create(dc));
  drawFilter(*to, GetClientSize(), *filter_, map_, view(), shared_->layers);
}

}  // namespace hybrid_slam
