/// The window driven like a user does: with real keys and the mouse, under a window manager.
#include <wx/display.h>
#include <wx/spinctrl.h>
#include <wx/timer.h>

#include <array>
#include <cstdio>
#include <string>
#include <utility>

#include "KeysTest.h"
#include "PathTypist.h"
#include "window/view/FilterScene.h"

namespace hybrid_slam {
namespace {

TEST_F(KeysTest, WorkFromTheStart) {
  log = longLog();
  openLog();
  press(WXK_F6);
  EXPECT_TRUE(stands(State::paused, 1));
  press(WXK_F5);
  EXPECT_TRUE(happens([this] { return now().scans > 3; }));
  press(WXK_F5);
  EXPECT_TRUE(happens([this] { return now().state == State::paused; }));
  press('G', wxMOD_CONTROL);
  EXPECT_TRUE(happens([this] { return !dialogs.titles.empty(); }));
  EXPECT_THAT(dialogs.titles, testing::ElementsAre("Go to scan"));
  const wxWindow* const before = wxWindow::FindFocus();
  press(WXK_TAB);
  EXPECT_TRUE(happens([&] { return wxWindow::FindFocus() && wxWindow::FindFocus() != before; }));
}

/// Types a number into the dialog with this title, and Return; each step waits for the previous one.
class NumberTypist : public wxTimer {
 public:
  NumberTypist(Dialogs& dialogs, std::string title, int number) : title_(std::move(title)), number_(number) {
    dialogs.left = title_;
    Start(200);
  }
  void Notify() override {
    for (wxWindow* each : wxTopLevelWindows) {
      auto* const dialog = dynamic_cast<wxDialog*>(each);
      if (!dialog || !dialog->IsModal() || dialog->GetTitle() != title_) continue;
      if (++ticks_ > 200) return dialog->EndModal(wxID_CANCEL);  // else the test would not end
      for (wxWindow* control : dialog->GetChildren())
        if (auto* const field = dynamic_cast<wxSpinCtrl*>(control)) return typeInto(field);
    }
  }

 private:
  void typeInto(wxSpinCtrl* field) {
    if (step_ == 0) {
      ++step_;  // first: the simulator may run the window
      field->SetFocus();
      wxUIActionSimulator().Char('A', wxMOD_CONTROL);
      wxUIActionSimulator().Text(std::to_string(number_).c_str());
    } else if (step_ == 1) {
      ++step_;
      wxUIActionSimulator().Char(WXK_RETURN);
    }
  }
  std::string title_;
  int number_, step_ = 0, ticks_ = 0;
};

TEST_F(KeysTest, ATypedNumberGoesToItsScan) {
  openLog();
  const NumberTypist typist(dialogs, "Go to scan", 25);
  press('G', wxMOD_CONTROL);
  EXPECT_TRUE(stands(State::paused, 25));
}

TEST_F(KeysTest, AClickOnTheSliderGoesToItsScan) {
  openLog();
  const wxSlider* const slider = frame->replay()->slider();
  const wxRect area = slider->GetScreenRect();
  wxUIActionSimulator().MouseMove(area.GetPosition() + wxPoint(3 * area.width / 4, area.height / 2));
  wxYield();
  wxUIActionSimulator().MouseClick();
  EXPECT_TRUE(happens([&] { return now().state == State::paused && now().scans > 35 && now().scans < 55; }))
      << now().scans << " of 60";
  EXPECT_TRUE(happens([&] { return static_cast<size_t>(slider->GetValue()) == now().scans; }));
}

TEST_F(KeysTest, SpaceAndArrowsControlTheReplay) {
  log = longLog();
  openLog();
  for (wxWindow* focus :
       {static_cast<wxWindow*>(frame->replay()->canvas(1)), frame->replay()->stepButton()}) {
    frame->replay()->restart();
    ASSERT_TRUE(stands(State::paused, 0));
    focus->SetFocus();
    press(WXK_RIGHT);
    EXPECT_TRUE(stands(State::paused, 1));
    press(WXK_RIGHT);
    EXPECT_TRUE(stands(State::paused, 2));
    press(WXK_LEFT);
    EXPECT_TRUE(stands(State::paused, 1));
    press(WXK_SPACE);
    EXPECT_TRUE(happens([this] { return now().scans > 3; }));
    press(WXK_SPACE);
    EXPECT_TRUE(happens([this] { return now().state == State::paused; }));
  }
}

TEST_F(KeysTest, ControlAndArrowsChangeTheSpeed) {
  openLog();
  press(WXK_UP, wxMOD_CONTROL);
  EXPECT_TRUE(happens([this] { return frame->replay()->speed() == "2 x"; })) << frame->replay()->speed();
  press(WXK_DOWN, wxMOD_CONTROL);
  press(WXK_DOWN, wxMOD_CONTROL);
  EXPECT_TRUE(happens([this] { return frame->replay()->speed() == "0.5 x"; })) << frame->replay()->speed();
}

TEST_F(KeysTest, BackByAKeyDoesNotReplayAll) {
  openAt(40);
  press(WXK_LEFT);
  EXPECT_TRUE(stands(State::paused, 39));
  EXPECT_EQ(now().run, 1u) << "from a checkpoint";
}

TEST_F(KeysTest, TheVerdictOfAFinishedReplayIsShown) {
  openLog();
  for (int i = 0; i < 5; ++i) press(WXK_UP, wxMOD_CONTROL);
  ASSERT_TRUE(happens([this] { return frame->replay()->speed() == "fastest"; })) << frame->replay()->speed();
  press(WXK_SPACE);
  ASSERT_TRUE(stands(State::ended, 60));
  for (const size_t i : {0u, 1u}) {
    const window::MapCanvas& pane = *frame->replay()->canvas(i);
    ASSERT_TRUE(happens([&] { return pane.shown() && pane.shown() == now().filters.at(i); }));
    ASSERT_TRUE(pane.shown()->verdict) << "pane " << i;
    EXPECT_EQ(captionOf(*pane.shown()).back(), "so far " + pane.shown()->verdict->name());
    EXPECT_NE(pane.shown()->verdict->name(), "lost") << "pane " << i;
  }
}

/// What the caption says is compared with what the screen shows: each line, blue or orange along its length.
TEST_F(KeysTest, TheCaptionCountsTheLinesThatAreDrawnAsMatched) {
  openAt(20);
  press('7', wxMOD_CONTROL);  // the legend's strokes have these colours
  const window::MapCanvas& pane = *frame->replay()->canvas(0);
  const wxPoint corner = pane.ClientToScreen(wxPoint(0, 0));
  const double scale = frame->GetContentScaleFactor();
  const auto isDrawn = [&](const wxImage& screen, const LineSegment& line, const std::array<int, 3>& colour) {
    constexpr int kSamples = 40;
    int found = 0;
    for (int k = 0; k <= kSamples; ++k) {
      const auto at = line.start + (line.end - line.start) * (1. * k / kSamples);
      const auto p = pane.view().toPicture(at.x, at.y, pane.size());
      const int x = static_cast<int>(scale * (corner.x + p.x)),
                y = static_cast<int>(scale * (corner.y + p.y));
      found += std::abs(screen.GetRed(x, y) - colour[0]) < 40 &&
                       std::abs(screen.GetGreen(x, y) - colour[1]) < 40 &&
                       std::abs(screen.GetBlue(x, y) - colour[2]) < 40
                   ? 1
                   : 0;
    }
    return found > kSamples / 2;
  };
  size_t matchedInAll = 0;
  for (size_t scan = 21; scan <= 28; ++scan) {
    press(WXK_RIGHT);
    ASSERT_TRUE(stands(State::paused, scan));
    ASSERT_TRUE(happens([&] { return pane.shown() == now().filters.at(0); }));
    size_t database = 0, matched = 0, all = 0;
    const std::vector<std::string> caption = captionOf(*pane.shown());
    ASSERT_TRUE(std::any_of(caption.begin(), caption.end(), [&](const std::string& line) {
      return std::sscanf(line.c_str(), "%zu lines; of the scan: %zu of %zu match", &database, &matched,
                         &all) == 3;
    })) << testing::PrintToString(caption);
    const wxImage screen = screenshot("matched-" + std::to_string(scan));
    size_t blue = 0, orange = 0;
    for (const window::ScanLine& line : pane.shown()->scanLines) {
      blue += isDrawn(screen, line.segment, {0, 70, 230}) ? 1 : 0;
      orange += isDrawn(screen, line.segment, {245, 130, 0}) ? 1 : 0;
    }
    EXPECT_EQ(blue, matched) << "scan " << scan;
    EXPECT_EQ(blue + orange, all) << "scan " << scan;
    matchedInAll += matched;
  }
  EXPECT_GT(matchedInAll, 0u);
}

TEST_F(KeysTest, AtFullSpeedTheSliderStandsWhereThePanesAre) {
  frame->open(ini, log, {}, {"particle_filter.update_distance=0.001"});  // every scan is an update
  ASSERT_TRUE(stands(State::paused, 0));
  ASSERT_TRUE(isReady());
  for (int i = 0; i < 5; ++i) press(WXK_UP, wxMOD_CONTROL);
  ASSERT_TRUE(happens([this] { return frame->replay()->speed() == "fastest"; })) << frame->replay()->speed();
  press(WXK_SPACE);
  EXPECT_TRUE(happens([this] {
    const auto place = static_cast<size_t>(frame->replay()->slider()->GetValue());
    for (const size_t i : {0u, 1u}) {
      const auto& shown = frame->replay()->canvas(i)->shown();
      EXPECT_EQ(shown ? shown->updates : 0, place) << "pane " << i;
    }
    return place == 60;
  }));
}

TEST_F(KeysTest, ControlAndRAskForALogOfAnyFormat) {
  press('R', wxMOD_CONTROL);
  EXPECT_TRUE(happens([this] { return dialogs.titles.size() == 1; }));
  for (const char* ending :
       {"*.rawlog", "*.clf", "*.gfs", "*.dat", "*.bag", "*.db3", "*.mcap", "*.gz", "*.bz2", "*.zst", "*.lz4"})
    EXPECT_THAT(dialogs.filter, HasSubstr(ending));
  press('R', wxMOD_CONTROL | wxMOD_SHIFT);
  EXPECT_TRUE(happens([this] { return dialogs.titles.size() == 2; }));
  EXPECT_THAT(dialogs.titles, testing::ElementsAre("Open log", "Open recording folder"));
}

TEST_F(KeysTest, ALogIsOpenedByItsTypedPathWithoutAnIniFile) {
  const PathTypist typist(dialogs, "Open log", log);
  press('R', wxMOD_CONTROL);
  ASSERT_TRUE(happens([this] { return frame->replay()->session() != nullptr; }));
  EXPECT_TRUE(stands(State::paused, 0));
  EXPECT_EQ(frame->settings()->configuration.run.rawlog, log);
  EXPECT_THAT(dialogs.titles, testing::Each("Open log")) << "no other dialog asks for anything";
  EXPECT_TRUE(dialogs.messages.empty());
}

TEST_F(KeysTest, WithoutALogThereIsNothingToPlay) {
  size_t controls = 0;
  for (wxWindow* control : frame->replay()->GetChildren())
    if (dynamic_cast<wxButton*>(control) || dynamic_cast<wxChoice*>(control) ||
        dynamic_cast<wxSlider*>(control)) {
      EXPECT_FALSE(control->IsEnabled()) << control->GetLabel();
      ++controls;
    }
  EXPECT_EQ(controls, 6u);
  for (const int command : {window::kPlay, window::kStep, window::kStepBack, window::kRestart, window::kSeek,
                            window::kExportResults, window::kSaveMap, window::kExportPicture})
    EXPECT_FALSE(frame->GetMenuBar()->IsEnabled(command)) << command;
  EXPECT_THAT(frame->replay()->canvas(0)->title(), HasSubstr("Open log"));
  press(WXK_SPACE);
  press(WXK_F6);
  EXPECT_EQ(frame->replay()->session(), nullptr);
  openLog();
  EXPECT_THAT(frame->replay()->canvas(0)->title(), HasSubstr("press Space"));
  click(frame->replay()->stepButton());
  EXPECT_TRUE(stands(State::paused, 1));
  EXPECT_TRUE(dialogs.messages.empty());
}

TEST_F(KeysTest, ALogNeedsNoSettings) {
  frame->open("", log);
  ASSERT_TRUE(stands(State::paused, 0));
  ASSERT_TRUE(isReady());
  press(WXK_F4);
  EXPECT_TRUE(happens([this] { return !dialogs.titles.empty(); }));
  EXPECT_THAT(dialogs.titles, testing::ElementsAre("Parameters"));
  press('S', wxMOD_CONTROL);
  EXPECT_TRUE(happens([this] { return dialogs.titles.size() == 2; }));
  EXPECT_TRUE(dialogs.messages.empty());
}

TEST_F(KeysTest, WhatIsDroppedIsOpened) {
  drop(log);
  EXPECT_TRUE(stands(State::paused, 0));
  EXPECT_NE(frame->settings()->configuration.filter.filter.particles, 8);
  drop(ini);
  EXPECT_EQ(frame->settings()->configuration.filter.filter.particles, 8);
  EXPECT_EQ(frame->settings()->configuration.run.rawlog, log) << "the INI file names none";
  EXPECT_THAT(frame->GetTitle().utf8_string(), HasSubstr("laps.rawlog"));
  EXPECT_TRUE(stands(State::paused, 0));
  EXPECT_TRUE(dialogs.messages.empty());
}

TEST_F(KeysTest, AFileThatIsNoLogLeavesTheOpenOne) {
  openAt(20);
  const wxString title = frame->GetTitle();
  size_t messages = 0;
  for (const std::string& file :
       {folder.write("noise.rawlog", std::string("\1\2\3\0", 4)), folder.write("notes.txt", "no log\n")}) {
    drop(file);
    ASSERT_TRUE(happens([&] { return dialogs.messages.size() == messages + 1; })) << file;
    EXPECT_THAT(dialogs.messages.back(), HasSubstr(file));
    ++messages;
  }
  EXPECT_TRUE(stands(State::paused, 20));
  EXPECT_EQ(frame->GetTitle(), title);
  EXPECT_EQ(frame->settings()->configuration.run.rawlog, log);
  EXPECT_EQ(frame->GetMenuBar()->FindItem(window::kRecentFiles)->GetSubMenu()->GetMenuItemCount(), 2u)
      << "the log and the INI file";
}

TEST_F(KeysTest, TheWindowFitsTheScreen) {
  auto* const another = new window::MainFrame;
  another->Show();
  ASSERT_TRUE(happens([&] { return another->IsActive(); }));
  const wxRect screen = wxDisplay(0u).GetClientArea();
  EXPECT_TRUE(happens([&] { return screen.Contains(another->GetScreenRect()); }));
  delete another;
}

TEST_F(KeysTest, TheLivePageSaysThatThereIsNoConnectionAndItsRecordingCanBeReplayed) {
  press('2', wxMOD_ALT);
  ASSERT_TRUE(happens([this] { return frame->live()->IsShownOnScreen(); }));
  test::Events events;
  auto server = std::make_unique<live::ObservationServer>("127.0.0.1", 0, live::ObservationServer::Limits{},
                                                          events.log());
  connectWithKeys("127.0.0.1:1", folder.path("refused"));
  ASSERT_TRUE(happens([this] { return frame->live()->note().find("trying again") != std::string::npos; }));
  EXPECT_EQ(frame->live()->state(), "no connection, trying");
  press(WXK_SPACE);
  ASSERT_TRUE(happens([this] { return dialogs.messages.size() == 1; }));
  EXPECT_THAT(dialogs.messages[0], HasSubstr("no scan with odometry received"));

  connectWithKeys("127.0.0.1:" + std::to_string(server->port()), folder.path("live"));
  ASSERT_TRUE(happens([&] { return server->clients() == 1; }));
  publishLaps(*server);
  ASSERT_TRUE(happens([this] { return frame->live()->state() == "60 scans, running"; }));
  press(WXK_SPACE);
  ASSERT_TRUE(happens([this] { return dialogs.messages.size() == 2; }));
  press('1', wxMOD_ALT);
  ASSERT_TRUE(happens([this] { return frame->replay()->IsShownOnScreen(); }));
  ASSERT_NE(frame->replay()->session(), nullptr) << "the recording";
  ASSERT_TRUE(stands(State::paused, 0));
  press(WXK_RIGHT);
  EXPECT_TRUE(stands(State::paused, 1));
  EXPECT_EQ(dialogs.messages.size(), 2u);
}

TEST_F(KeysTest, ALiveRunBeginsWithAClickAndShowsTheVerdictSoFar) {
  press('2', wxMOD_ALT);
  ASSERT_TRUE(happens([this] { return frame->live()->IsShownOnScreen(); }));
  test::Events events;
  live::ObservationServer server("127.0.0.1", 0, {}, events.log());
  frame->live()->setServer("127.0.0.1:" + std::to_string(server.port()));
  frame->live()->setOutput(folder.path("live"));
  click(frame->live()->connectButton());
  ASSERT_TRUE(happens([&] { return server.clients() == 1; }));
  publishLaps(server);
  EXPECT_TRUE(happens([this] {
    const auto& shown = frame->live()->canvas()->shown();
    return shown && captionOf(*shown).back().rfind("so far ", 0) == 0;
  }));

  const wxString title = frame->GetTitle();
  drop(log);
  ASSERT_EQ(dialogs.messages.size(), 1u);
  EXPECT_THAT(dialogs.messages[0], HasSubstr("a live run is in progress"));
  EXPECT_EQ(frame->GetTitle(), title);
  EXPECT_EQ(frame->settings()->configuration.run.rawlog, "") << "nothing has changed";
  EXPECT_EQ(frame->replay()->session(), nullptr);
  click(frame->live()->connectButton());
  ASSERT_TRUE(happens([this] { return dialogs.messages.size() == 2; }));
  EXPECT_THAT(dialogs.messages[1], HasSubstr("recording-20"));
}

}  // namespace
}  // namespace hybrid_slam
