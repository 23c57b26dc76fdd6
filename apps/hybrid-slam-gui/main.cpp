/// @file main.cpp
/// @brief hybrid-slam-gui: replays rawlogs and follows robots in a window.

#include <wx/app.h>
#include <wx/image.h>
#include <wx/log.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdlib>
#include <iostream>

#include "gui/MainFrame.h"

namespace {

std::string config, rawlog;

class GuiApp : public wxApp {
 public:
  bool OnInit() override {
    wxInitAllImageHandlers();
    auto* const frame = new hybrid_slam::MainFrame;
    frame->Show();
    if (!config.empty()) frame->CallAfter([frame] { frame->open(config, rawlog); });
    return true;
  }
};

}  // namespace

wxIMPLEMENT_APP_NO_MAIN(GuiApp);

int main(int argc, char** argv) {
  CLI::App app{"Replays rawlogs through the hybrid and the general filter, and follows robots, in a window",
               "hybrid-slam-gui"};
  app.set_version_flag("--version", "hybrid-slam-gui " HYBRID_SLAM_VERSION);
  app.add_option("config", config, "INI file (doc/configuration.md)");
  app.add_option("dataset", rawlog, "rawlog, plain or gzipped; else [run] rawlog of the INI file");
  app.footer("Keys are in the menus; more in doc/gui.md. Exit: 0 closed, 1 no display, 2 wrong command line.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    std::cerr << "hybrid-slam-gui: error: " << e.what() << ": command line; see hybrid-slam-gui --help\n";
    return 2;
  }
  if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY")) {
    std::cerr << "hybrid-slam-gui: error: no display: DISPLAY and WAYLAND_DISPLAY are unset; expected a desktop, "
                 "ssh -X or xvfb-run\n";
    return 1;
  }
  std::signal(SIGPIPE, SIG_IGN);  // a server that hangs up is an event of the live page
  int none = 1;                   // the arguments are ours, not wxWidgets's
  return wxEntry(none, argv);
}
