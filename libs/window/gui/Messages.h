/// @file Messages.h
/// @brief Error dialogs with the one-line messages of the programs.
#pragma once

#include <wx/msgdlg.h>

#include <string>

#include "base/Errors.h"

namespace hybrid_slam::window {

inline void showError(wxWindow* parent, const std::string& message) {
  wxMessageDialog(parent, wxString::FromUTF8(message), "hybrid-slam: error", wxOK | wxICON_ERROR).ShowModal();
}

inline void showNotice(wxWindow* parent, const std::string& message) {
  wxMessageDialog(parent, wxString::FromUTF8(message), "hybrid-slam", wxOK | wxICON_INFORMATION).ShowModal();
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
