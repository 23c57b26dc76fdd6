/// @file MainFrame.h
/// @brief The main window: menus with shortcuts, the replay and the live page.
#pragma once

#include <wx/dnd.h>
#include <wx/frame.h>
#include <wx/notebook.h>
#include <wx/timer.h>

#include <memory>
#include <string>

#include "window/gui/LivePage.h"
#include "window/gui/MenuBar.h"
#include "window/gui/RecentFiles.h"
#include "window/gui/ReplayPage.h"
#include "window/gui/Settings.h"

namespace hybrid_slam::window {

/// The window.
class MainFrame : public wxFrame {
 public:
  MainFrame();

  /// Shows errors in the files in a dialog.
  /// @param rawlog   empty: [run] rawlog of the INI file, if it names one
  /// @param changes  SECTION.KEY=VALUE each
  void open(const std::string& ini, const std::string& rawlog, const MapChoice& map = {},
            const std::vector<std::string>& changes = {});
  /// Makes later runs continue or localise in this map, or begin with this floor plan.
  void useMap(const MapChoice& map);
  /// @param changes  SECTION.KEY=VALUE each @param resets  SECTION.KEY each, which get their defaults
  void applyChanges(const std::vector<std::string>& changes, const std::vector<std::string>& resets = {});

  /// @name Menu actions with a chosen file
  /// @throws InputError if it cannot be written, or there is nothing to write
  /// @{
  void saveIniTo(const std::string& file) const;
  void exportPictureTo(const std::string& file) const;  ///< PNG, 1600 x 1200
  void exportResultsTo(const std::string& folder);
  void saveReplayMapTo(const std::string& folder);  ///< the replay continues
  /// @}

  ReplayPage* replay() const { return replay_; }
  LivePage* live() const { return live_; }
  const Settings* settings() const { return settings_.get(); }

 private:
  /// Opens a log or INI file that is dropped on the window.
  class FileDrop : public wxFileDropTarget {
   public:
    explicit FileDrop(MainFrame& frame) : frame_(frame) {}
    bool OnDropFiles(wxCoord x, wxCoord y, const wxArrayString& names) override;

   private:
    MainFrame& frame_;
  };

  void bindFileMenu();
  void bindReplayMenu();
  void bindViewMenu();
  void bindHelpMenu();
  void bindKeys();
  void enableCommands();
  bool isReplayShown() const { return pages_->GetSelection() == 0; }
  MapCanvas* canvas() const { return isReplayShown() ? replay_->canvas(0) : live_->canvas(); }
  void use(const std::shared_ptr<Settings>& settings);
  void followLog();
  void openIni();
  void openIni(const std::string& ini);
  void openRecent(int command);
  void openLog();
  void openLog(const std::string& log);
  void openFolder();
  void openFile(const std::string& file);
  void saveIni();
  void exportPicture();
  void exportResults();
  void openMap();
  void saveMap();
  void showState();
  std::string cursorText() const;
  std::shared_ptr<const FilterSnapshot> shownFilter() const;
  void askForScan();
  void editParameters();

  std::shared_ptr<const Settings> settings_;
  wxNotebook* pages_;
  ReplayPage* replay_;
  LivePage* live_;
  wxTimer timer_;
  wxString note_;                                     ///< shown last
  std::shared_ptr<const run::LogSettings> followed_;  ///< in the settings
  std::unique_ptr<RecentFiles> recent_;
};

}  // namespace hybrid_slam::window
