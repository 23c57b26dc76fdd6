/// @file MenuBar.h
/// @brief The commands of the window, in menus with their keys.
#pragma once

#include <wx/menu.h>

namespace hybrid_slam::window {

/// Menu entries.
enum Command {
  kOpenIni = wxID_HIGHEST + 1,
  kOpenLog,
  kSaveIni,
  kExportPicture,
  kExportResults,
  kOpenMap,
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
  kReplayPage,
  kLivePage
};

wxMenuBar* makeMenuBar();

}  // namespace hybrid_slam::window
