/// @file GuiTest.h
/// @brief For the tests of the window: a window on a virtual screen, its dialogs answered.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <wx/app.h>
#include <wx/dirdlg.h>
#include <wx/evtloop.h>
#include <wx/filedlg.h>
#include <wx/image.h>
#include <wx/modalhook.h>
#include <wx/msgdlg.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <functional>

#include "Screen.h"
#include "base/Errors.h"
#include "files/TemporaryFolder.h"
#include "live/ObservationServer.h"
#include "run/Replay.h"
#include "testing/TestEvents.h"
#include "testing/TestLogs.h"
#include "window/gui/MainFrame.h"
#include "window/gui/MapDialog.h"
#include "window/gui/ParametersDialog.h"

namespace hybrid_slam {

using State = window::ReplaySnapshot::State;
using testing::HasSubstr;

/// Answers dialogs instead of the user.
class Dialogs : public wxModalDialogHook {
 public:
  std::vector<std::string> messages;  ///< of message boxes
  std::vector<std::string> titles;    ///< of other dialogs, which are cancelled
  std::string filter;                 ///< of the last file dialog
  std::string left;                   ///< title of a dialog that the test answers itself
  wxDialog* open = nullptr;           ///< this dialog, while it is shown
 protected:
  int Enter(wxDialog* dialog) override {
    if (auto* const message = dynamic_cast<wxMessageDialogBase*>(dialog)) {
      messages.push_back(message->GetMessage().utf8_string());
      return wxID_OK;
    }
    wxString title = dialog->GetTitle();
    if (const auto* const folder = dynamic_cast<wxDirDialogBase*>(dialog)) title = folder->GetMessage();
    if (const auto* const file = dynamic_cast<wxFileDialogBase*>(dialog)) {
      title = file->GetMessage();
      filter = file->GetWildcard().utf8_string();
    }
    titles.push_back(title.utf8_string());
    if (titles.back() != left) return wxID_CANCEL;
    open = dialog;
    return wxID_NONE;
  }
  void Exit(wxDialog* dialog) override {
    if (dialog == open) open = nullptr;
  }
};

class GuiTest : public testing::Test {
 protected:
  void SetUp() override {
    setenv("XDG_CONFIG_HOME", folder.path("config").c_str(), 1);  // not that of the tester
    dialogs.Register();
    frame = new window::MainFrame;
    frame->Move(0, 0);
    frame->Show();
    ini = folder.write("run.ini",
                       "[particle_filter]\nparticles = 8\nproposal = standard\nupdate_distance = "
                       "0.2\n[grid]\nresolution = 0.05\n");
    log = test::writeGzipped(folder.path("laps.rawlog"), test::laps(60));
  }
  void TearDown() override {
    delete frame;
    dialogs.Unregister();
  }
  /// Runs the window until a condition holds. @return whether it did within a minute
  bool happens(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (!condition()) {
      if (std::chrono::steady_clock::now() > end) return false;
      wxYield();
      wxMilliSleep(2);
    }
    return true;
  }
  void settle(double seconds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    happens([&] { return std::chrono::steady_clock::now() > end; });
  }
  void menu(int command) {
    wxCommandEvent event(wxEVT_MENU, command);
    event.SetEventObject(frame);
    frame->ProcessWindowEvent(event);
  }
  window::ReplaySnapshot now() { return *frame->replay()->session()->snapshot(); }
  bool stands(State state, size_t scans) {
    return happens([&] { return now().state == state && now().scans == scans; });
  }
  /// Returns the screen; also writes a PNG to the folder named by HYBRID_SLAM_SCREENSHOTS.
  wxImage screenshot(const std::string& name) {
    settle(0.4);
    const test::Screen screen = test::grabScreen();
    wxImage image(screen.width, screen.height);
    std::copy(screen.rgb.begin(), screen.rgb.end(), image.GetData());
    if (const char* const to = std::getenv("HYBRID_SLAM_SCREENSHOTS")) {
      const wxRect all = onScreen(frame->GetScreenRect()).Intersect(wxRect(image.GetSize()));
      image.GetSubImage(all).SaveFile(std::string(to) + "/" + name + ".png", wxBITMAP_TYPE_PNG);
    }
    return image;
  }
  /// Takes screenshots until one meets a condition. @return whether one did within a minute
  bool screenShows(const std::string& name, const std::function<bool(const wxImage&)>& condition) {
    return happens([&] { return condition(screenshot(name)); });
  }
  /// Converts to screen pixels, which are smaller than window units on a high-DPI screen.
  wxRect onScreen(const wxRect& r) const {
    const int scale = wxRound(frame->GetContentScaleFactor());
    return {scale * r.x, scale * r.y, scale * r.width, scale * r.height};
  }
  /// Number of pixels of a window with a colour.
  size_t count(const wxImage& screen, const wxWindow& window, int red, int green, int blue) const {
    const wxRect area = onScreen({window.ClientToScreen(wxPoint(0, 0)), window.GetClientSize()});
    size_t found = 0;
    for (int y = area.GetTop(); y <= area.GetBottom(); ++y)
      for (int x = area.GetLeft(); x <= area.GetRight(); ++x)
        found += std::abs(screen.GetRed(x, y) - red) < 40 && std::abs(screen.GetGreen(x, y) - green) < 40 &&
                         std::abs(screen.GetBlue(x, y) - blue) < 40
                     ? 1
                     : 0;
    return found;
  }
  /// The grey of the screen at a place of the map.
  int greyAt(const wxImage& screen, const window::MapCanvas& canvas, double x, double y) const {
    const auto at = canvas.view().toPicture(x, y, canvas.size());
    const wxPoint corner = canvas.ClientToScreen(wxPoint(0, 0));
    const double scale = frame->GetContentScaleFactor();
    const wxPoint p(static_cast<int>(scale * (corner.x + at.x)), static_cast<int>(scale * (corner.y + at.y)));
    return screen.GetRed(p.x, p.y);
  }

  /// Connects the live page to the server, with the results in `live` of the folder.
  void connectTo(const live::ObservationServer& server) {
    frame->live()->setServer("127.0.0.1:" + std::to_string(server.port()));
    frame->live()->setOutput(folder.path("live"));
    frame->live()->connectOrStop();
    ASSERT_TRUE(happens([&] { return server.clients() == 1; }));
  }

  /// Publishes 60 scans of laps.
  void publishLaps(
      live::ObservationServer& server, const std::function<void(size_t)>& after = [](size_t) {}) {
    const test::Log all = test::laps(60);
    for (size_t i = 0; i + 1 < all.size(); i += 2) {
      mrpt::obs::CSensoryFrame cycle;
      for (const size_t j : {i, i + 1})
        cycle.insert(std::dynamic_pointer_cast<mrpt::obs::CObservation>(all[j]));
      server.publish(cycle);
      settle(0.03);
      after(i);
    }
  }
  std::string status(int field) { return frame->GetStatusBar()->GetStatusText(field).utf8_string(); }

  files::TemporaryFolder folder;
  Dialogs dialogs;
  window::MainFrame* frame = nullptr;
  std::string ini, log;
};

}  // namespace hybrid_slam
