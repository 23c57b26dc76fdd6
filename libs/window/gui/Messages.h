/// @file Messages.h
/// @brief Error dialogs with the one-line messages of the programs.
#pragma once

#include <wx/msgdlg.h>

#include <string>

namespace hybrid_slam::window {

inline void showError(wxWindow* parent, const std::string& message) {
  wxMessageDialog(parent, wxString::FromUTF8(message), "hybrid-slam: error", wxOK | wxICON_ERROR).ShowModal();
}

inline void showNotice(wxWindow* parent, const std::string& message) {
  wxMessageDialog(parent, wxString::FromUTF8(message), "hybrid-slam", wxOK | wxICON_INFORMATION).ShowModal();
}

}  // namespace hybrid_slam::window
