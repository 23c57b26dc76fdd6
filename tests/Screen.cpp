// Separate from the test, because Xlib's macros clash with GoogleTest.
#include "Screen.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <stdexcept>

namespace hybrid_slam::test {

Screen grabScreen() {
  Display* const display = XOpenDisplay(nullptr);
  if (!display) throw std::runtime_error("no X display");
  const int number = DefaultScreen(display);
  Screen screen{DisplayWidth(display, number), DisplayHeight(display, number), {}};
  XImage* const image =
      XGetImage(display, RootWindow(display, number), 0, 0, static_cast<unsigned>(screen.width),
                static_cast<unsigned>(screen.height), AllPlanes, ZPixmap);
  if (!image) throw std::runtime_error("no picture of the X display");
  for (int y = 0; y < screen.height; ++y)
    for (int x = 0; x < screen.width; ++x) {
      const unsigned long pixel = XGetPixel(image, x, y);
      for (const int shift : {16, 8, 0})
        screen.rgb.push_back(static_cast<unsigned char>((pixel >> shift) & 0xFF));
    }
  XDestroyImage(image);
  XCloseDisplay(display);
  return screen;
}

bool hasWindowManager() {
  Display* const display = XOpenDisplay(nullptr);
  if (!display) throw std::runtime_error("no X display");
  const Atom running = XInternAtom(display, "_NET_SUPPORTING_WM_CHECK", False);
  Atom type = None;
  int format = 0;
  unsigned long count = 0, left = 0;
  unsigned char* value = nullptr;
  XGetWindowProperty(display, DefaultRootWindow(display), running, 0, 1, False, AnyPropertyType, &type,
                     &format, &count, &left, &value);
  if (value) XFree(value);
  XCloseDisplay(display);
  return type != None;
}

}  // namespace hybrid_slam::test
