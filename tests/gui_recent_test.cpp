/// Recent files, and the map of an earlier run, by the keys of the menus.
#include "KeysTest.h"

namespace hybrid_slam {
namespace {

class RecentFilesTest : public KeysTest {
 protected:
  /// As if the program were started again.
  void startAgain() {
    delete frame;
    frame = new window::MainFrame;
    frame->Move(0, 0);
    frame->Show();
    ASSERT_TRUE(happens([this] { return frame->IsActive(); }));
  }
  /// File, Recent files, the entry with this number.
  void openRecent(char number) {
    press('F', wxMOD_ALT);
    settle(0.3);
    press('F');
    settle(0.3);
    press(number);
    settle(0.3);
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
  ASSERT_NE(frame->replay()->session(), nullptr) << "the log";
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

TEST_F(RecentFilesTest, ASessionIsChosenByAKey) {
  press('M', wxMOD_CONTROL);
  EXPECT_TRUE(happens([this] { return !dialogs.titles.empty(); }));
  EXPECT_THAT(dialogs.titles, testing::ElementsAre("Map of an earlier run"));
}

}  // namespace
}  // namespace hybrid_slam
