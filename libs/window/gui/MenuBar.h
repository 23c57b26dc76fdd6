/// @file MenuBar.h
/// @brief The commands of the window, in menus with their keys.
#pragma once

#include <wx/menu.h>

namespace hybrid_slam::window {

/// Menu entries.
enum MenuCommand {
  kOpenIni = wxID_HIGHEST + 1,
  kOpenLog,
  kOpenFolder,
  kSaveIni,
  kExportPicture,
  kExportResults,
  kOpenMap,
  kRecentFiles,
  kSaveMap,
  kPlay,
  kStep,
  kStepBack,
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
  kLegend,
  kReplayPage,
  kLivePage,
  kWhatIsThis,
  kFirstPage  ///< of HelpPages.h; the others follow
};

/// Makes the menu bar, which its frame will own.
wxMenuBar* makeMenuBar();

}  // namespace hybrid_slam::window
