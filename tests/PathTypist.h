/// @file PathTypist.h
/// @brief For the tests of the window: types a path into GTK's dialog for files.
#pragma once

#include <wx/timer.h>
#include <wx/uiaction.h>

#include <string>

#include "GuiTest.h"

namespace hybrid_slam {

/// Types a path into the dialog with a title, once it has the keyboard, and presses Return.
class PathTypist : public wxTimer {
 public:
  PathTypist(Dialogs& dialogs, const std::string& title, const std::string& path)
      : dialogs_(dialogs), path_(path) {
    dialogs_.left = title;
    constexpr int kInterval = 50;  // ms
    Start(kInterval);
  }
  void Notify() override {
    if (!dialogs_.open) return;
    constexpr int kEnough = 1000;  // else the test would not end
    if (++ticks_ > kEnough) return dialogs_.open->EndModal(wxID_CANCEL);
    if (isTyped_ || test::activeTitle() != dialogs_.left) return;
    isTyped_ = true;  // first: the simulator may run the window
    wxUIActionSimulator().Text(path_.c_str());
    wxUIActionSimulator().Char(WXK_RETURN);
  }

 private:
  Dialogs& dialogs_;
  std::string path_;
  int ticks_ = 0;
  bool isTyped_ = false;
};

}  // namespace hybrid_slam
