/// @file WhatIsThis.h
/// @brief Help texts of the controls, for "What is this?" (Shift+F1).
#pragma once

#include <wx/cshelp.h>
#include <wx/tipwin.h>
#include <wx/window.h>

namespace hybrid_slam::window {

/// Shows wider lines than wxSimpleHelpProvider, which breaks them after 100 pixels.
class WideHelp : public wxSimpleHelpProvider {
 public:
  bool ShowHelp(wxWindowBase* window) override {
    const wxString text = GetHelpTextMaybeAtPoint(window);
    if (text.empty()) return false;
    new wxTipWindow(static_cast<wxWindow*>(window), text, window->FromDIP(320));  // deletes itself
    return true;
  }
};

/// Sets the text shown when the user asks what a control is.
inline void explain(wxWindow* control, const wxString& text) {
  if (!wxHelpProvider::Get()) wxHelpProvider::Set(new WideHelp);  // wxWidgets deletes it
  control->SetHelpText(text);
}

/// Sets the help text of a control, and shows it as a tooltip too.
inline void explainWithTip(wxWindow* control, const wxString& text) {
  explain(control, text);
  control->SetToolTip(text);
}

}  // namespace hybrid_slam::window
