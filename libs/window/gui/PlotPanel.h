/// @file PlotPanel.h
/// @brief Particle spread and effective sample size over time, one curve per filter.
#pragma once

#include <wx/geometry.h>
#include <wx/panel.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "window/view/FilterSnapshot.h"

class wxGraphicsContext;

namespace hybrid_slam::window {

/// Text for "What is this?".
inline const char* const kPlotsHelp =
    "Over log time: the standard deviations of the particles' poses, and the effective sample size (ESS) as "
    "a "
    "share of the particles. Small deviations: the filter is sure of the pose.";

/// Four plots in a row: std x (m), std y (m), std phi (deg), ESS (fraction).
class PlotPanel : public wxPanel {
 public:
  explicit PlotPanel(wxWindow* parent);
  void show(const std::vector<std::shared_ptr<const FilterSnapshot>>& filters);

  static constexpr size_t kCount = 4;                      ///< plots
  static const std::array<std::string, kCount>& titles();  ///< above the plots, from left to right
  /// Returns the place of a plot with its title, and that of the methods' names, in the panel.
  wxRect2DDouble plotArea(size_t i) const;
  wxRect2DDouble namesArea() const;

 private:
  void onPaint(wxPaintEvent&);
  std::vector<std::shared_ptr<const FilterSnapshot>> filters_;
};

}  // namespace hybrid_slam::window
