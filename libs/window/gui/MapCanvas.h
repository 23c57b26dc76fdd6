/// @file MapCanvas.h
/// @brief A pane that shows one filter; wheel: zoom, drag: move, double click: fit.
#pragma once

#include <mrpt/gui/CWxGLCanvasBase.h>

#include <functional>
#include <memory>
#include <optional>

#include "window/view/FilterScene.h"

namespace hybrid_slam::window {

/// Text for "What is this?".
inline const char* const kPaneHelp =
    "The best particle's map, from above. The legend names the colours; the status bar shows the place under "
    "the mouse pointer and the probability that its cell is occupied. Wheel: zoom. Drag: move. Double click: "
    "the whole map.";

/// View shared by adjacent panes, so that they show the same part of the map.
struct SharedView {
  std::optional<MapView> fixed;  ///< view set by the user; empty: each pane shows its whole map
  Layers layers;
};

/// A pane; all panes of a page share their view.
class MapCanvas : public mrpt::gui::CWxGLCanvasBase {
 public:
  /// @param title      shown while there is no map, in lines of at most 40 letters
  /// @param onChange   called after a change of the shared view, to redraw the other panes
  MapCanvas(wxWindow* parent, const std::string& title, std::shared_ptr<SharedView> shared,
            std::function<void()> onChange);

  void show(const std::shared_ptr<const FilterSnapshot>& filter);
  /// Sets the text shown while there is no map.
  void setTitle(const std::string& title);
  const std::string& title() const { return title_; }
  void zoom(double factor);
  /// Describes the place under the mouse pointer and its cell; empty outside the pane, and without a map.
  std::string cursorText() const;
  const std::shared_ptr<const FilterSnapshot>& shown() const { return filter_; }
  MapView view() const;
  /// Returns the size in window units, which are larger than pixels on a high-DPI screen.
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
  std::optional<wxPoint> cursor_;  ///< while it is over the pane
};

}  // namespace hybrid_slam::window
