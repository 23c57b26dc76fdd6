/// @file MainFrame.h
/// @brief The main window: menus with shortcuts, the replay and the live page.
#pragma once

#include <wx/frame.h>
#include <wx/notebook.h>
#include <wx/timer.h>

#include <memory>
#include <string>

#include "window/gui/LivePage.h"
#include "window/gui/ReplayPage.h"
#include "window/gui/Settings.h"

namespace hybrid_slam::window {

/// Menu entries.
enum Command {
  kOpenIni = wxID_HIGHEST + 1,
  kOpenRawlog,
  kSaveIni,
  kExportPicture,
  kExportResults,
  kOpenMap,
  kSaveMap,
  kPlay,
  kStep,
  kRestart,
  kSeek,
  kFaster,
  kSlower,
  kParameters,
  kZoomIn,
  kZoomOut,
  kFit,
  kGeneral,
  kParticles,
  kPath,
  kLines,
  kScanLines,
  kEllipse,
  kReplayPage,
  kLivePage
};

class MainFrame : public wxFrame {
 public:
  MainFrame();

  /// Shows errors in the files in a dialog.
  /// @param rawlog   empty: [run] rawlog of the INI file, if it names one
  /// @param changes  SECTION.KEY=VALUE each
  void open(const std::string& ini, const std::string& rawlog, const MapChoice& map = {},
            const std::vector<std::string>& changes = {});
  /// Later runs map on or localise in this map.
  void useMap(const MapChoice& map);
  void applyChanges(const std::vector<std::string>& changes);

  /// @name Menu actions with a chosen file
  /// @throws InputError if it cannot be written, or there is nothing to write
  /// @{
  void saveIniTo(const std::string& file) const;
  void exportPictureTo(const std::string& file) const;  ///< PNG, 1600 x 1200
  void exportResultsTo(const std::string& folder);
  void saveReplayMapTo(const std::string& folder);  ///< the replay goes on
  /// @}

  ReplayPage* replay() const { return replay_; }
  LivePage* live() const { return live_; }
  const Settings* settings() const { return settings_.get(); }

 private:
  void makeMenus();
  void bindFileMenu();
  void bindReplayMenu();
  void bindViewMenu();
  void use(const std::shared_ptr<Settings>& settings);
  void openIni();
  void openRawlog();
  void saveIni();
  void exportPicture();
  void exportResults();
  void openMap();
  void saveMap();
  void showState();
  std::shared_ptr<const FilterSnapshot> shownFilter() const;
  void askForScan();
  void editParameters();

  std::shared_ptr<const Settings> settings_;
  wxNotebook* pages_;
  ReplayPage* replay_;
  LivePage* live_;
  wxTimer timer_;
  wxString note_;  ///< shown last
};

}  // namespace hybrid_slam::window
