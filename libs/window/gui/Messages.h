/// @file Messages.h
/// @brief Dialogs that say what is wrong, where, and what was expected: the line that programs print.
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
