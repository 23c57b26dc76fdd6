/// @file MapDialog.h
/// @brief Asks for the map of an earlier run or a floor plan, its use, and the start in it.
#pragma once

#include <wx/dialog.h>
#include <wx/filepicker.h>
#include <wx/radiobox.h>
#include <wx/textctrl.h>

#include "window/gui/Settings.h"

namespace hybrid_slam::window {

/// The dialog *Map or floor plan*.
class MapDialog : public wxDialog {
 public:
  MapDialog(wxWindow* parent, const MapChoice& now);

  void set(const MapChoice& map);
  /// @throws InputError for a missing file, or a start that is not a pose
  MapChoice choice() const;
  /// Parses "X, Y, DEG" (m, deg) as a pose; empty for blanks.
  /// @throws InputError for anything else
  static std::optional<mrpt::math::TPose2D> startOf(const std::string& text);

 private:
  wxFilePickerCtrl* file_;
  wxRadioBox* use_;
  wxTextCtrl* start_;
};

}  // namespace hybrid_slam::window
