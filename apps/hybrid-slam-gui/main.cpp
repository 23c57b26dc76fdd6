/// @file main.cpp
/// @brief hybrid-slam-gui: replays logs and maps live robot data in a window.

#include <wx/app.h>
#include <wx/glcanvas.h>
#include <wx/image.h>
#include <wx/log.h>
#include <wx/timer.h>
#include <wx/weakref.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdlib>
#include <memory>

#include "FilterArguments.h"
#include "InputFiles.h"
#include "Program.h"
#include "SessionArguments.h"
#include "SettingArguments.h"
#include "Stop.h"
#include "window/gui/MainFrame.h"

#include <X11/Xlib.h>  // last: its macros are common words

namespace {

using hybrid_slam::window::MainFrame;
using hybrid_slam::window::MapChoice;

hybrid_slam::InputFiles files;
MapChoice map;
std::vector<std::string> settings;

/// Ends the program with the results of a live run. Without closing the window, which an open dialog still
/// needs.
[[noreturn]] void endWithResults(MainFrame* frame, int code) {
  frame->replay()->end();
  const std::string failure = frame->live()->end();
  std::_Exit(failure.empty() ? code : hybrid_slam::fail(1, "live run failed: " + failure));
}

wxWeakRef<MainFrame> shown;

/// Ends the program after a stop signal.
class StopTimer : public wxTimer {
 public:
  StopTimer() { Start(100); }
  void Notify() override {
    if (hybrid_slam::stop && shown) endWithResults(shown, 0);
  }
};

/// Xlib calls this when the X server is gone. GTK's own handler would end the program without a word.
int displayLost(Display*) {
  hybrid_slam::fail(1, "the X server has closed the connection");
  if (shown) endWithResults(shown, 1);
  std::_Exit(1);
}

/// Without a desktop, GTK prints a warning for each setting that it cannot keep.
void keepNoGtkSettings() {
  if (!std::getenv("DBUS_SESSION_BUS_ADDRESS")) setenv("GSETTINGS_BACKEND", "memory", 0);
}

class GuiApp : public wxApp {
 public:
  bool OnInit() override {
    wxDisableAsserts();  // without OpenGL wxWidgets would open an assert dialog
    wxGLAttributes attributes;
    attributes.PlatformDefaults().RGBA().DoubleBuffer().Depth(24).EndList();
    if (!wxGLCanvas::IsDisplaySupported(attributes)) {
      hybrid_slam::fail(1,
                        "no OpenGL on this display; expected GLX (Debian: libgl1-mesa-dri; ssh -X has none)");
      return false;
    }
    wxInitAllImageHandlers();
    auto* const frame = new MainFrame;
    shown = frame;
    frame->Show();
    XSetIOErrorHandler(displayLost);
    stopTimer_ = std::make_unique<StopTimer>();
    if (!files.main().empty() || !map.file.empty() || !settings.empty())
      frame->CallAfter([frame] { frame->open(files.config, files.log, map, settings); });
    return true;
  }

 private:
  std::unique_ptr<StopTimer> stopTimer_;
};

}  // namespace

wxIMPLEMENT_APP_NO_MAIN(GuiApp);

int main(int argc, char** argv) {
  const auto parseAndShow = [&] {
    CLI::App app{
        "Replays logs in a window, with the hybrid filter next to another method, and maps live robot data",
        "hybrid-slam-gui"};
    app.set_version_flag("--version", "hybrid-slam-gui " HYBRID_SLAM_VERSION);
    files.add(app, hybrid_slam::logMeans() + " (default: [run] rawlog)");
    hybrid_slam::FilterArguments filter;
    filter.addMethod(app);
    filter.addParticles(app);
    hybrid_slam::SessionArguments session;
    session.addMap(app);
    hybrid_slam::addSettings(app, settings);
    app.footer(
        "The menus list the shortcut keys; manual: doc/gui.md.\n"
        "Exit: 0 closed, 1 no display, no OpenGL, the display was lost, or a signal ended a live run that\n"
        "failed, 2 wrong command line.");
    if (const auto code = hybrid_slam::parse(app, argc, argv)) return *code;
    files.sort();
    filter.addTo(settings, app);
    hybrid_slam::run::RunOptions run;
    session.addTo(run);
    map = MapChoice::of(run);
    // Debian's wxWidgets uses GLX for OpenGL; on Wayland, XWayland provides it.
    if (!std::getenv("DISPLAY"))
      return hybrid_slam::fail(
          1, "no display: DISPLAY is unset; expected an X11 or XWayland desktop, or xvfb-run");
    setenv("GDK_BACKEND", "x11", 0);
    keepNoGtkSettings();
    hybrid_slam::stopOnSignals();
    int none = 1;  // wxWidgets gets no arguments
    return wxEntry(none, argv) == 0 ? 0 : 1;
  };
  return hybrid_slam::exitCodeOf(parseAndShow);
}
