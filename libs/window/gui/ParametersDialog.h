/// @file ParametersDialog.h
/// @brief Table of all sections and keys of the INI file, checked like the file.
#pragma once

#include <wx/dialog.h>
#include <wx/propgrid/propgrid.h>

#include <memory>
#include <vector>

#include "window/gui/Settings.h"

namespace hybrid_slam::window {

class ParametersDialog : public wxDialog {
 public:
  ParametersDialog(wxWindow* parent, const Settings& settings);

  /// The edits, as SECTION.KEY=VALUE.
  const std::vector<std::string>& changes() const { return changes_; }
  /// Error text for a value, empty if valid.
  static std::string fault(const Settings& settings, const std::string& section, const std::string& key,
                           const std::string& value);

 private:
  void onChanging(wxPropertyGridEvent& event);
  void onChanged(wxPropertyGridEvent& event);

  std::shared_ptr<Settings> settings_;  ///< receives the values, which checks them
  wxPropertyGrid* grid_;
  std::vector<std::string> changes_;
};

}  // namespace hybrid_slam::window
