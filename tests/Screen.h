/// @file Screen.h
/// @brief What the X server shows. (wxScreenDC would give the first picture again and again: cairo keeps it.)
#pragma once

#include <vector>

namespace hybrid_slam::test {

struct Screen {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;
};

Screen grabScreen();

}  // namespace hybrid_slam::test
