/// @file Screen.h
/// @brief Reads the X server's screen. (wxScreenDC would always return the first picture, cached by cairo.)
#pragma once

#include <string>
#include <vector>

namespace hybrid_slam::test {

struct Screen {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;
};

Screen grabScreen();

/// Returns whether a window manager runs, which gives windows the keyboard.
bool hasWindowManager();

/// Returns the title of the window that has the keyboard, also of one that wxWidgets does not know as active;
/// empty if no window has it.
std::string activeTitle();

}  // namespace hybrid_slam::test
