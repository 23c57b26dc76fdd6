/// The window as a user drives it: with real keys and the mouse, under a window manager.
#include <wx/display.h>
#include <wx/dnd.h>

#include "KeysTest.h"

namespace hybrid_slam {
namespace {

TEST_F(KeysTest, WorkFromTheStart) {
  openLog();
  press(WXK_F6);
  EXPECT_TRUE(stands(State::paused, 1));
  press('G', wxMOD_CONTROL);
  EXPECT_TRUE(happens([this] { return !dialogs.titles.empty(); }));
  EXPECT_THAT(dialogs.titles, testing::ElementsAre("Go to scan"));
  const wxWindow* const before = wxWindow::FindFocus();
  press(WXK_TAB);
  EXPECT_TRUE(happens([&] { return wxWindow::FindFocus() && wxWindow::FindFocus() != before; }));
}

TEST_F(KeysTest, SpaceAndArrowsControlTheReplay) {
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
    EXPECT_LT(now().scans, 60u);
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

TEST_F(KeysTest, WithoutALogThereIsNothingToPlay) {
  EXPECT_FALSE(frame->replay()->stepButton()->IsEnabled());
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
  press(WXK_F4);
  EXPECT_TRUE(happens([this] { return !dialogs.titles.empty(); }));
  EXPECT_THAT(dialogs.titles, testing::ElementsAre("Parameters"));
  press('S', wxMOD_CONTROL);
  EXPECT_TRUE(happens([this] { return dialogs.titles.size() == 2; }));
  EXPECT_TRUE(dialogs.messages.empty());
}

TEST_F(KeysTest, ALogThatIsDroppedIsOpened) {
  wxArrayString names;
  names.Add(log);
  auto* const target = dynamic_cast<wxFileDropTarget*>(frame->GetDropTarget());
  ASSERT_NE(target, nullptr);
  EXPECT_TRUE(target->OnDropFiles(0, 0, names));
  EXPECT_TRUE(stands(State::paused, 0));
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
  frame->live()->setServer("127.0.0.1:1");
  frame->live()->setOutput(folder.path("refused"));
  frame->live()->connectOrStop();
  ASSERT_TRUE(happens([this] { return frame->live()->note().find("trying again") != std::string::npos; }));
  EXPECT_EQ(frame->live()->state(), "no connection, trying");
  frame->live()->connectOrStop();
  ASSERT_TRUE(happens([this] { return dialogs.messages.size() == 1; }));
  EXPECT_THAT(dialogs.messages[0], HasSubstr("no scan with odometry received"));

  frame->live()->setServer("127.0.0.1:" + std::to_string(server->port()));
  frame->live()->setOutput(folder.path("live"));
  frame->live()->connectOrStop();
  ASSERT_TRUE(happens([&] { return server->clients() == 1; }));
  publishLaps(*server);
  ASSERT_TRUE(happens([this] { return frame->live()->state() == "60 scans, running"; }));
  frame->live()->connectOrStop();
  ASSERT_TRUE(happens([this] { return dialogs.messages.size() == 2; }));
  press('1', wxMOD_ALT);
  ASSERT_TRUE(happens([this] { return frame->replay()->IsShownOnScreen(); }));
  ASSERT_NE(frame->replay()->session(), nullptr) << "the recording";
  ASSERT_TRUE(stands(State::paused, 0));
  press(WXK_RIGHT);
  EXPECT_TRUE(stands(State::paused, 1));
  EXPECT_EQ(dialogs.messages.size(), 2u);
}

}  // namespace
}  // namespace hybrid_slam
