/// @file ParametersDialog.h
/// @brief Table of all sections and keys of the INI file, checked like the file, with search and reset.
#pragma once

#include <wx/button.h>
#include <wx/dialog.h>
#include <wx/propgrid/propgrid.h>
#include <wx/srchctrl.h>
#include <wx/stattext.h>

#include <map>
#include <memory>
#include <set>
#include <vector>

#include "window/gui/Settings.h"

namespace hybrid_slam::window {

/// Keys that differ from their defaults are bold.
class ParametersDialog : public wxDialog {
 public:
  ParametersDialog(wxWindow* parent, const Settings& settings);

  /// Returns the edits as SECTION.KEY=VALUE.
  const std::vector<std::string>& changes() const { return changes_; }
  /// Returns the keys to reset to their defaults, as SECTION.KEY.
  std::vector<std::string> resets() const { return {resets_.begin(), resets_.end()}; }
  /// Returns the error text for a value; empty if it is valid.
  static std::string fault(const Settings& settings, const std::string& section, const std::string& key,
                           const std::string& value);

  wxPropertyGrid* grid() const { return grid_; }
  wxSearchCtrl* search() const { return search_; }
  wxButton* resetButton() const { return reset_; }
  wxButton* resetAllButton() const { return resetAll_; }

 private:
  struct Section {
    wxPGProperty* category;
    std::vector<wxPGProperty*> keys;
  };

  void addSections();
  void addControls();
  void showMatches();
  void showHelp();
  void reset(wxPGProperty* property);
  void resetAll();
  bool isDefault(const wxPGProperty* property) const;
  void mark(wxPGProperty* property);
  void onChanging(wxPropertyGridEvent& event);
  void onChanged(wxPropertyGridEvent& event);

  std::shared_ptr<Settings> settings_;  ///< receives the values, which checks them
  std::vector<Section> sections_;
  std::map<std::string, std::string> defaults_;  ///< by SECTION.KEY
  wxPropertyGrid* grid_;
  wxSearchCtrl* search_;
  wxStaticText* help_;
  wxButton *reset_, *resetAll_;
  std::vector<std::string> changes_;
  std::set<std::string> resets_;
};

}  // namespace hybrid_slam::window
