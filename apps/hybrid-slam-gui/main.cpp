/// @file main.cpp
/// @brief hybrid-slam-gui: replays rawlogs and follows robots in a window.

#include <wx/app.h>
#include <wx/glcanvas.h>
#include <wx/image.h>
#include <wx/log.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdlib>

#include "Program.h"
#include "window/gui/MainFrame.h"

namespace {

std::string config, rawlog;

class GuiApp : public wxApp {
 public:
  bool OnInit() override {
    wxDisableAsserts();  // wxWidgets would stop with a question where there is no OpenGL
    wxGLAttributes attributes;
    attributes.PlatformDefaults().RGBA().DoubleBuffer().Depth(24).EndList();
    if (!wxGLCanvas::IsDisplaySupported(attributes)) {
      hybrid_slam::fail(1,
                        "no OpenGL on this display; expected GLX (Debian: libgl1-mesa-dri; ssh -X has none)");
      return false;
    }
    wxInitAllImageHandlers();
    auto* const frame = new hybrid_slam::window::MainFrame;
    frame->Show();
    if (!config.empty()) frame->CallAfter([frame] { frame->open(config, rawlog); });
    return true;
  }
};

}  // namespace

wxIMPLEMENT_APP_NO_MAIN(GuiApp);

int main(int argc, char** argv) {
  const auto parseAndShow = [&] {
    CLI::App app{"Replays rawlogs through the hybrid and the general filter, and follows robots, in a window",
                 "hybrid-slam-gui"};
    app.set_version_flag("--version", "hybrid-slam-gui " HYBRID_SLAM_VERSION);
    app.add_option("config", config, "INI file (doc/configuration.md)");
    app.add_option("dataset", rawlog, "rawlog, plain or gzipped; else [run] rawlog of the INI file");
    app.footer(
        "Keys are in the menus; more in doc/gui.md. Exit: 0 closed, 1 no display or no OpenGL, 2 wrong "
        "command line.");
    if (const auto code = hybrid_slam::parse(app, argc, argv)) return *code;
    // Debian's wxWidgets has its OpenGL from GLX: a Wayland desktop serves it by XWayland.
    if (!std::getenv("DISPLAY"))
      return hybrid_slam::fail(
          1, "no display: DISPLAY is unset; expected an X11 or XWayland desktop, or xvfb-run");
    setenv("GDK_BACKEND", "x11", 0);
    std::signal(SIGPIPE, SIG_IGN);  // a server that hangs up is an event of the live page
    int none = 1;                   // the arguments are ours, not wxWidgets's
    return wxEntry(none, argv) == 0 ? 0 : 1;
  };
  return hybrid_slam::exitCodeOf(parseAndShow);
}
