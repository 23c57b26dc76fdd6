/// @file MapCanvas.h
/// @brief A pane of the window that shows one filter; the wheel zooms, dragging moves, a double click fits.
#pragma once

#include <mrpt/gui/CWxGLCanvasBase.h>

#include <functional>
#include <memory>
#include <optional>

#include "window/view/FilterScene.h"

namespace hybrid_slam::window {

/// What panes side by side share, so that the same place of the map is at the same place in each.
struct SharedView {
  std::optional<MapView> fixed;  ///< as zoomed or moved by hand; nothing: each pane shows its whole map
  Layers layers;
};

class MapCanvas : public mrpt::gui::CWxGLCanvasBase {
 public:
  /// @param title      shown while there is no map
  /// @param onChange   called when the shared view was changed here, so that the other panes are drawn too
  MapCanvas(wxWindow* parent, const std::string& title, std::shared_ptr<SharedView> shared,
            std::function<void()> onChange);

  void show(const std::shared_ptr<const FilterSnapshot>& filter);
  void zoom(double factor);
  const std::shared_ptr<const FilterSnapshot>& shown() const { return filter_; }
  MapView view() const;
  /// In the window's units, which are larger than pixels where the screen is dense.
  PictureSize size() const;

 private:
  void paint();
  void onWheel(wxMouseEvent& event);
  void onMotion(wxMouseEvent& event);
  void zoomAt(const wxPoint& at, double factor);
  mrpt::opengl::COpenGLScene::Ptr titleScene() const;

  std::string title_;
  std::shared_ptr<SharedView> shared_;
  std::function<void()> onChange_;
  std::shared_ptr<const FilterSnapshot> filter_;
  mrpt::opengl::CTexturedPlane::Ptr map_;
  wxPoint lastMouse_;
};

}  // namespace hybrid_slam::window
