/// @file ParametersDialog.h
/// @brief Every section and key of the INI file in a table, checked as the file is.
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

  /// What was edited, as SECTION.KEY=VALUE.
  const std::vector<std::string>& changes() const { return changes_; }
  /// What is wrong with a value, or nothing: where, what was expected.
  static std::string fault(const Settings& settings, const std::string& section, const std::string& key,
                           const std::string& value);

 private:
  void onChanging(wxPropertyGridEvent& event);
  void onChanged(wxPropertyGridEvent& event);

  std::shared_ptr<Settings> settings_;  ///< takes the values, so that each is checked
  wxPropertyGrid* grid_;
  std::vector<std::string> changes_;
};

}  // namespace hybrid_slam::window
