/// @file EventList.h
/// @brief What has happened in a run, a line each, the newest last.
#pragma once

#include <wx/listbox.h>

#include <string>
#include <vector>

#include "window/gui/Messages.h"
#include "window/gui/WhatIsThis.h"

namespace hybrid_slam::window {

class EventList : public wxListBox {
 public:
  /// @param help  for "What is this?"
  EventList(wxWindow* parent, const wxSize& size, const wxString& help)
      : wxListBox(parent, wxID_ANY, wxDefaultPosition, parent->FromDIP(size)) {
    explain(this, help);
  }

  void show(const std::vector<std::string>& events) {
    if (events == shown_) return;
    shown_ = events;
    Clear();
    for (const std::string& line : events) Append(shownText(line));
    if (!events.empty()) EnsureVisible(static_cast<int>(events.size()) - 1);
  }

 private:
  std::vector<std::string> shown_;
};

}  // namespace hybrid_slam::window
