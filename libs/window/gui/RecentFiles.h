/// @file RecentFiles.h
/// @brief The logs and INI files opened last, kept between runs of the window.
#pragma once

#include <wx/fileconf.h>
#include <wx/filehistory.h>
#include <wx/menu.h>

#include <string>

namespace hybrid_slam::window {

/// Up to nine files, the newest first, in ~/.config/hybrid-slam-gui.conf (or $XDG_CONFIG_HOME).
class RecentFiles {
 public:
  /// @param menu  gets an entry for each file, with the commands wxID_FILE1 to wxID_FILE9
  explicit RecentFiles(wxMenu* menu);

  void add(const std::string& file);
  void remove(const std::string& file);
  /// Returns the file of an entry. @param command  wxID_FILE1 to wxID_FILE9
  std::string file(int command) const;
  bool isEmpty() const { return history_.GetCount() == 0; }

 private:
  void save();

  wxFileConfig config_;
  wxFileHistory history_;
};

}  // namespace hybrid_slam::window
