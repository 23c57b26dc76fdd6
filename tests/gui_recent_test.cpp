/// Recent files, and the map of an earlier run, by the keys of the menus.
#include "KeysTest.h"
#include "PathTypist.h"

namespace hybrid_slam {
namespace {

using Use = window::MapChoice::Use;

/// Fills in the dialog of Ctrl+M with real keys and a click; each step waits for the previous one.
class MapTypist : public wxTimer {
 public:
  MapTypist(Dialogs& dialogs, const std::string& file, Use wanted, const std::string& start)
      : file_(file), wanted_(static_cast<int>(wanted)), start_(start) {
    dialogs.left = "Map or floor plan";
    Start(200);
  }

  void Notify() override {
    auto* const dialog = open();
    if (!dialog) return;
    if (++ticks_ > 200) return dialog->EndModal(wxID_CANCEL);  // else the test would not end
    wxTextCtrl *file = nullptr, *start = nullptr;
    wxRadioBox* use = nullptr;
    for (wxWindow* control : dialog->GetChildren()) {
      if (auto* const picker = dynamic_cast<wxFilePickerCtrl*>(control)) file = picker->GetTextCtrl();
      if (auto* const box = dynamic_cast<wxRadioBox*>(control)) use = box;
      if (auto* const text = dynamic_cast<wxTextCtrl*>(control)) start = text;
    }
    if (step_ == 0) type(file, file_);
    if (step_ == 1 && file->GetValue() == file_) {
      if (!isChosen(use)) return click(use);
      ++step_;
    }
    if (step_ == 2) type(start, start_);
    if (step_ == 3 && start->GetValue() == start_) {
      ++step_;
      wxUIActionSimulator().Char(WXK_RETURN);
    }
  }

 private:
  static window::MapDialog* open() {
    for (wxWindow* each : wxTopLevelWindows)
      if (auto* const dialog = dynamic_cast<window::MapDialog*>(each); dialog && dialog->IsModal())
        return dialog;
    return nullptr;
  }
  bool isChosen(const wxRadioBox* use) const { return use->GetSelection() == wanted_; }
  void type(wxTextCtrl* into, const std::string& text) {
    if (wxWindow::FindFocus() != into) return into->SetFocus();
    ++step_;  // first: the simulator may run the window
    wxUIActionSimulator().Text(text.c_str());
  }
  void click(wxRadioBox* use) const {
    for (int y = 0; y < use->GetSize().y; ++y) {
      const wxPoint edge = use->ClientToScreen(wxPoint(use->FromDIP(20), y));
      if (use->GetItemFromPoint(edge) != wanted_) continue;
      wxUIActionSimulator mouse;
      mouse.MouseMove(edge + wxPoint(0, use->FromDIP(8)));
      return (void)mouse.MouseClick();
    }
  }

  std::string file_;
  int wanted_;
  std::string start_;
  int step_ = 0, ticks_ = 0;
};

class RecentFilesTest : public KeysTest {
 protected:
  /// Makes a new window, as after a restart of the program.
  void startAgain() {
    delete frame;
    frame = new window::MainFrame;
    frame->Move(0, 0);
    frame->Show();
    ASSERT_TRUE(happens([this] { return frame->IsActive(); }));
  }
  /// Opens File, Recent files, and the entry with this number.
  void openRecent(char number) {
    ASSERT_TRUE(happens([this] { return entries()->IsEnabled(); }));
    ASSERT_TRUE(opensMenu('F', wxMOD_ALT));
    ASSERT_TRUE(opensMenu('F'));
    press(number);
  }
  wxMenuItem* entries() { return frame->GetMenuBar()->FindItem(window::kRecentFiles); }
};

TEST_F(RecentFilesTest, AreKeptAndOpened) {
  EXPECT_FALSE(entries()->IsEnabled()) << "none";
  openLog();
  startAgain();
  ASSERT_TRUE(happens([this] { return entries()->IsEnabled(); }));
  ASSERT_EQ(entries()->GetSubMenu()->GetMenuItemCount(), 2u);
  openRecent('2');
  ASSERT_TRUE(happens([this] { return frame->replay()->session() != nullptr; })) << "the log";
  EXPECT_TRUE(stands(State::paused, 0));
  EXPECT_EQ(frame->settings()->configuration.run.rawlog, log);
  EXPECT_NE(frame->settings()->configuration.filter.filter.particles, 8) << "the defaults";
  openRecent('2');  // the log is the first now
  EXPECT_TRUE(happens([this] { return frame->settings()->configuration.filter.filter.particles == 8; }));
  EXPECT_TRUE(dialogs.messages.empty());
}

TEST_F(RecentFilesTest, AFileThatIsGoneIsSaidAndForgotten) {
  frame->open("", log);
  ASSERT_TRUE(stands(State::paused, 0));
  std::filesystem::remove(log);
  openRecent('1');
  ASSERT_TRUE(happens([this] { return dialogs.messages.size() == 1; }));
  EXPECT_THAT(dialogs.messages[0], HasSubstr("no such file"));
  EXPECT_THAT(dialogs.messages[0], HasSubstr(log));
  EXPECT_EQ(dialogs.messages[0].find('\n'), std::string::npos) << "one line";
  EXPECT_TRUE(happens([this] { return !entries()->IsEnabled(); }));
  startAgain();
  EXPECT_EQ(entries()->GetSubMenu()->GetMenuItemCount(), 0u);
}

/// A recording of ROS 2 is a folder.
TEST_F(RecentFilesTest, AFolderIsOpened) {
  const std::string recording = folder.path("recording");
  std::filesystem::create_directory(recording);
  folder.write("recording/drive_0.mcap", "no messages");
  frame->open("", recording);
  ASSERT_TRUE(happens([this] { return dialogs.messages.size() == 1; }));
  openRecent('1');
  ASSERT_TRUE(happens([this] { return dialogs.messages.size() == 2; }));
  EXPECT_EQ(dialogs.messages[1], dialogs.messages[0]) << "what is wrong with it";
  EXPECT_TRUE(entries()->IsEnabled());
}

/// The map of an earlier run: saved by Ctrl+Shift+S and a typed folder, typed into the dialog of Ctrl+M.
class EarlierMapTest : public KeysTest {
 protected:
  void saveMapByKeys() {
    const std::string maps = folder.path("maps"), title = "Folder for the maps (hybrid/ and general/ in it)";
    std::filesystem::create_directory(maps);
    openAt(40);
    const PathTypist typist(dialogs, title, maps);
    press('S', wxMOD_CONTROL | wxMOD_SHIFT);
    ASSERT_TRUE(happens([&] { return status(0) == "map saved: " + maps; })) << status(0);
    EXPECT_THAT(dialogs.titles, testing::Each(title));
    dialogs.titles.clear();
    for (const char* method : {"/hybrid", "/general"})
      EXPECT_TRUE(std::filesystem::exists(maps + method + "/session.hslam")) << method;
  }
  /// Opens the saved map at its origin, and plays.
  void playIn(Use use) {
    const MapTypist typist(dialogs, session, use, "0, 0, 0");
    press('M', wxMOD_CONTROL);
    ASSERT_TRUE(happens([&] { return frame->settings()->map().use == use; }));
    EXPECT_THAT(dialogs.titles, testing::ElementsAre("Map or floor plan"));
    const window::MapChoice chosen = frame->settings()->map();
    EXPECT_EQ(chosen.file, session);
    ASSERT_TRUE(chosen.start);
    ASSERT_TRUE(stands(State::paused, 0));
    ASSERT_TRUE(isReady());
    press(WXK_SPACE);
  }

  const std::string session = folder.path("maps/hybrid/session.hslam");
};

TEST_F(EarlierMapTest, IsOpenedByItsTypedPath) {
  saveMapByKeys();
  const PathTypist typist(dialogs, "Map or floor plan", session);
  press('M', wxMOD_CONTROL);
  ASSERT_TRUE(happens([&] { return frame->settings()->map().use == Use::mapOn; }));
  EXPECT_EQ(frame->settings()->map().file, session);
  EXPECT_TRUE(stands(State::paused, 0));
}

TEST_F(EarlierMapTest, TheSameChoiceLeavesTheReplayAlone) {
  openAt(40);
  const PathTypist typist(dialogs, "Map or floor plan", "");
  press('M', wxMOD_CONTROL);
  ASSERT_TRUE(happens([&] { return dialogs.titles.size() == 1 && !dialogs.open; }));
  EXPECT_TRUE(stands(State::paused, 40));
  EXPECT_EQ(now().run, 1u);
}

TEST_F(EarlierMapTest, IsLocalisedIn) {
  saveMapByKeys();
  playIn(Use::localise);
  EXPECT_TRUE(happens([this] { return status(1) == "localised"; })) << status(1);
  EXPECT_TRUE(dialogs.messages.empty());
}

TEST_F(EarlierMapTest, IsContinued) {
  saveMapByKeys();
  playIn(Use::mapOn);
  const std::string found = "hybrid: place found after ", in = "in the map of " + session;
  EXPECT_TRUE(happens([&] {
    const auto events = now().events;
    return std::any_of(events.begin(), events.end(), [&](const std::string& event) {
      return event.rfind(found, 0) == 0 && event.find(in) != std::string::npos;
    });
  }));
  EXPECT_TRUE(dialogs.messages.empty());
}

}  // namespace
}  // namespace hybrid_slam
