// Separate from the test, because Xlib's macros clash with GoogleTest.
#include "Screen.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <cstring>
#include <stdexcept>

namespace hybrid_slam::test {
namespace {

/// Returns the bytes of a window's property; empty if it has none.
std::string propertyOf(Display* display, Window window, const char* name) {
  Atom type = None;
  int format = 0;
  unsigned long count = 0, left = 0;
  unsigned char* value = nullptr;
  XGetWindowProperty(display, window, XInternAtom(display, name, False), 0, 1024, False, AnyPropertyType,
                     &type, &format, &count, &left, &value);
  if (!value) return {};
  const size_t bytes = format == 32 ? sizeof(long) : static_cast<size_t>(format) / 8;  // of an item in Xlib
  const std::string content(reinterpret_cast<const char*>(value), count * bytes);
  XFree(value);
  return content;
}

}  // namespace

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
  const std::string check = propertyOf(display, DefaultRootWindow(display), "_NET_SUPPORTING_WM_CHECK");
  XCloseDisplay(display);
  return !check.empty();
}

std::string activeTitle() {
  Display* const display = XOpenDisplay(nullptr);
  if (!display) throw std::runtime_error("no X display");
  const std::string active = propertyOf(display, DefaultRootWindow(display), "_NET_ACTIVE_WINDOW");
  Window window = None;
  if (active.size() >= sizeof window) std::memcpy(&window, active.data(), sizeof window);
  const std::string title = window == None ? std::string() : propertyOf(display, window, "_NET_WM_NAME");
  XCloseDisplay(display);
  return title;
}

}  // namespace hybrid_slam::test
