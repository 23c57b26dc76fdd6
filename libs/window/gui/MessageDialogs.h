/// @file MessageDialogs.h
/// @brief Dialogs with the one-line messages of the programs.
#pragma once

#include <wx/msgdlg.h>

#include <string>

#include "base/Errors.h"
#include "files/InstalledFiles.h"

namespace hybrid_slam::window {

/// Returns a message as shown to the user, with the paths of installed pages. @param bin  folder of the
/// program
inline wxString shownText(const std::string& message,
                          const std::filesystem::path& bin = files::programFolder()) {
  return wxString::FromUTF8(files::withInstalledPages(message, bin));
}

/// Shows an error until it is confirmed.
inline void showError(wxWindow* parent, const std::string& message,
                      const std::filesystem::path& bin = files::programFolder()) {
  wxMessageDialog(parent, shownText(message, bin), "hybrid-slam: error", wxOK | wxICON_ERROR).ShowModal();
}

/// Shows a message until it is confirmed.
inline void showNotice(wxWindow* parent, const std::string& message,
                       const std::filesystem::path& bin = files::programFolder()) {
  wxMessageDialog(parent, shownText(message, bin), "hybrid-slam", wxOK | wxICON_INFORMATION).ShowModal();
}

/// Runs an action of the user; errors are shown in a dialog.
template <class Action>
void orTell(wxWindow* parent, const Action& action) {
  try {
    action();
  } catch (const std::exception& e) {
    showError(parent, messageOf(e));
  }
}

}  // namespace hybrid_slam::window
