/// @file EventList.h
/// @brief List of the events of a run, one per line, newest last.
#pragma once

#include <wx/listbox.h>

#include <string>
#include <vector>

#include "window/gui/MessageDialogs.h"
#include "window/gui/WhatIsThis.h"

namespace hybrid_slam::window {

/// The list; a long event is shown whole under the mouse pointer.
class EventList : public wxListBox {
 public:
  /// @param help  for "What is this?"
  EventList(wxWindow* parent, const wxSize& size, const wxString& help)
      : wxListBox(parent, wxID_ANY, wxDefaultPosition, parent->FromDIP(size)) {
    explain(this, help);
    Bind(wxEVT_MOTION, [this](wxMouseEvent& event) {
      showWhole(HitTest(event.GetPosition()));
      event.Skip();
    });
  }

  void show(const std::vector<std::string>& events) {
    if (events == shown_) return;
    shown_ = events;
    Clear();
    for (const std::string& line : events) Append(shownText(line));
    if (!events.empty()) EnsureVisible(static_cast<int>(events.size()) - 1);
  }

 private:
  /// A line may be longer than the list is wide: the tooltip is the whole line under the mouse pointer.
  void showWhole(int line) {
    const wxString text = line == wxNOT_FOUND ? wxString() : GetString(static_cast<unsigned>(line));
    if (text != GetToolTipText()) SetToolTip(text);
  }

  std::vector<std::string> shown_;
};

}  // namespace hybrid_slam::window
