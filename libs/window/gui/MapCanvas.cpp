#include "window/gui/MapCanvas.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace hybrid_slam::window {

MapCanvas::MapCanvas(wxWindow* parent, const std::string& title, std::shared_ptr<SharedView> shared,
                     std::function<void()> onChange)
    : CWxGLCanvasBase(parent), title_(title), shared_(std::move(shared)), onChange_(std::move(onChange)) {
  SetMinSize(FromDIP(wxSize(200, 200)));
  setUseCameraFromScene(true);
  // Handlers bound last are called first: these replace the base class's, which rotate the camera.
  Bind(wxEVT_PAINT, [this](wxPaintEvent&) { paint(); });
  Bind(wxEVT_MOUSEWHEEL, &MapCanvas::onWheel, this);
  Bind(wxEVT_MOTION, &MapCanvas::onMotion, this);
  Bind(wxEVT_ENTER_WINDOW, [](wxMouseEvent&) {});  // the base class would take the focus
  Bind(wxEVT_LEAVE_WINDOW, [this](wxMouseEvent&) { cursor_.reset(); });
  // The base class would swallow every key, also those of the menus.
  for (const auto& key : {wxEVT_CHAR, wxEVT_CHAR_HOOK})
    Unbind(key, &CWxGLCanvasBase::OnChar, static_cast<CWxGLCanvasBase*>(this));
  Bind(wxEVT_LEFT_DOWN, [this](wxMouseEvent& event) {
    SetFocus();
    lastMouse_ = event.GetPosition();
  });
  Bind(wxEVT_LEFT_DCLICK, [this](wxMouseEvent&) {
    shared_->fixed.reset();
    onChange_();
  });
}

void MapCanvas::show(const std::shared_ptr<const FilterSnapshot>& filter) {
  if (filter == filter_) return;
  filter_ = filter;
  map_ = filter ? mapPlane(filter->map) : nullptr;
  Refresh(false);
}

void MapCanvas::setTitle(const std::string& title) {
  if (title == title_) return;
  title_ = title;
  if (!filter_) Refresh(false);
}

PictureSize MapCanvas::size() const { return {GetClientSize().x, GetClientSize().y}; }

MapView MapCanvas::view() const {
  if (shared_->fixed) return *shared_->fixed;
  return filter_ ? wholeMap(filter_->map, shared_->layers, size()) : MapView();
}

void MapCanvas::zoom(double factor) { zoomAt({size().width / 2, size().height / 2}, factor); }

/// Keeps the position under the mouse fixed.
void MapCanvas::zoomAt(const wxPoint& at, double factor) {
  MapView next = view();
  const auto before = next.toMap(at.x, at.y, size());
  next.scale = std::clamp(next.scale * factor, 0.1, 2000.0);
  const auto after = next.toMap(at.x, at.y, size());
  next.centreX += before.x - after.x;
  next.centreY += before.y - after.y;
  shared_->fixed = next;
  onChange_();
}

void MapCanvas::onWheel(wxMouseEvent& event) {
  zoomAt(event.GetPosition(), std::pow(1.2, event.GetWheelRotation() / double(event.GetWheelDelta())));
}

std::string MapCanvas::cursorText() const {
  if (!cursor_ || !filter_) return "";
  // The middle of the pixel.
  const auto at = view().toMap(cursor_->x + 0.5, cursor_->y + 0.5, size());
  return describeCell(filter_->map, at.x, at.y);
}

void MapCanvas::onMotion(wxMouseEvent& event) {
  cursor_ = event.GetPosition();
  if (!event.Dragging() || !event.LeftIsDown()) return;
  MapView next = view();
  next.centreX -= (event.GetX() - lastMouse_.x) / next.scale;
  next.centreY += (event.GetY() - lastMouse_.y) / next.scale;
  lastMouse_ = event.GetPosition();
  shared_->fixed = next;
  onChange_();
}

mrpt::opengl::COpenGLScene::Ptr MapCanvas::titleScene() const {
  auto scene = mrpt::opengl::COpenGLScene::Create();
  scene->getViewport()->setCustomBackgroundColor({0.5f, 0.5f, 0.5f});
  mrpt::opengl::TFontParams font;
  font.vfont_name = "sans";
  font.vfont_scale = static_cast<float>(11 * GetContentScaleFactor());
  std::istringstream lines(title_);
  std::string line;
  for (size_t i = 0; std::getline(lines, line); ++i)
    scene->getViewport()->addTextMessage(font.vfont_scale, 0.5 - 0.08 * static_cast<double>(i), line, i,
                                         font);
  return scene;
}

void MapCanvas::paint() {
  const wxPaintDC dc(this);
  if (!m_gl_context || size().width <= 0 || size().height <= 0) return;
  const auto lock = mrpt::lockHelper(m_gl_context_mtx);
  SetCurrent(*m_gl_context);
  const double density = GetContentScaleFactor();
  setOpenGLSceneRef(filter_ ? filterScene(*filter_, map_, view(), shared_->layers, size(), density)
                            : titleScene());
  renderCanvas(static_cast<int>(size().width * density), static_cast<int>(size().height * density));
}

}  // namespace hybrid_slam::window
