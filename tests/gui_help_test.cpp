/// "What is this?" and the pages of the Help menu.
#include <wx/cshelp.h>
#include <wx/tipwin.h>

#include "KeysTest.h"
#include "window/gui/HelpPages.h"
#include "window/gui/MessageDialogs.h"

namespace hybrid_slam {
namespace {

/// Clicks a little later, in the loop that waits for the click.
class LaterClick : public wxTimer {
 public:
  explicit LaterClick(wxWindow* at) : at_(at) { StartOnce(500); }
  void Notify() override {
    const wxSize size = at_->GetClientSize();
    wxUIActionSimulator mouse;
    mouse.MouseMove(at_->ClientToScreen(wxPoint(size.x / 2, size.y / 2)));
    mouse.MouseClick();
  }

 private:
  wxWindow* at_;
};

class HelpTest : public KeysTest {
 protected:
  static wxTipWindow* tipOf(const wxWindow* window) {
    for (wxWindow* child : window->GetChildren())
      if (auto* const tip = dynamic_cast<wxTipWindow*>(child)) return tip;
    return nullptr;
  }
};

TEST_F(HelpTest, ShiftF1AndAClickSayWhatAControlIs) {
  openAt(40);
  for (wxWindow* control :
       {static_cast<wxWindow*>(frame->replay()->canvas(0)), frame->replay()->stepButton()}) {
    const LaterClick click(control);
    press(WXK_F1, wxMOD_SHIFT);
    EXPECT_TRUE(happens([&] { return tipOf(control) && tipOf(control)->IsShown(); })) << control->GetLabel();
    screenshot(control == frame->replay()->stepButton() ? "what-is-this-button" : "what-is-this");
    press(WXK_ESCAPE);
    if (wxTipWindow* const tip = tipOf(control)) tip->Close();
    happens([&] { return !tipOf(control); });
  }
  EXPECT_EQ(now().scans, 40u) << "the click asks, and does not step";
  EXPECT_THAT(frame->replay()->canvas(0)->GetHelpText().utf8_string(), HasSubstr("best particle's map"));
  EXPECT_THAT(frame->replay()->stepButton()->GetHelpText().utf8_string(), HasSubstr("One scan forward"));
}

TEST_F(HelpTest, EveryControlHasAText) {
  for (const wxWindow* page :
       {static_cast<wxWindow*>(frame->replay()), static_cast<wxWindow*>(frame->live())})
    for (const wxWindow* control : page->GetChildren()) {
      const auto* const text = dynamic_cast<const wxStaticText*>(control);
      if (text && control->GetLabel().EndsWith("server")) continue;  // beside the field
      if (text && control->GetLabel().EndsWith("results in")) continue;
      EXPECT_FALSE(control->GetHelpText().empty())
          << control->GetClassInfo()->GetClassName() << " " << control->GetLabel();
    }
}

/// A desktop whose program for pages writes the name of the page to a file.
class PagesTest : public HelpTest {
 protected:
  void SetUp() override {
    HelpTest::SetUp();
    std::filesystem::create_directories(folder.path("bin"));
    const std::string opener =
        folder.write("bin/xdg-open", "#!/bin/sh\nprintf %s \"$1\" > " + folder.path("opened") + "\n");
    std::filesystem::permissions(opener, std::filesystem::perms::owner_all);
    setenv("PATH", (folder.path("bin") + ":" + path).c_str(), 1);
    std::filesystem::current_path(folder.path(""));
  }
  void TearDown() override {
    std::filesystem::current_path(before);
    setenv("PATH", path.c_str(), 1);
    HelpTest::TearDown();
  }
  bool opens(const std::string& page) {
    return happens([&] {
      return std::filesystem::exists(folder.path("opened")) && test::contentOf(folder.path("opened")) == page;
    });
  }

 private:
  const std::string path = std::getenv("PATH");
  const std::filesystem::path before = std::filesystem::current_path();
};

/// Simulates a build without packages, whose folder may be anywhere.
TEST_F(PagesTest, F1OpensThePageOfTheWindow) {
  std::filesystem::current_path(SOURCE_DIR);
  press(WXK_F1);
  EXPECT_TRUE(opens(SOURCE_DIR "/doc/gui.md"));
  EXPECT_TRUE(dialogs.messages.empty());
}

TEST_F(PagesTest, ThoseAroundTheBuildFolderAreOpenedIfNoneIsInstalled) {
  for (const char* made : {"build/bin", "doc", "share/doc/hybrid-slam/doc"})
    std::filesystem::create_directories(folder.path(made));
  const std::string source = folder.write("doc/gui.md", "# Window\n");
  std::filesystem::current_path("/");
  window::openPage("doc/gui.md", folder.path("build/bin"));
  EXPECT_TRUE(opens(source));
  const std::string installed = folder.write("share/doc/hybrid-slam/doc/gui.md", "# Window\n");
  window::openPage("doc/gui.md", folder.path("bin"));
  EXPECT_TRUE(opens(installed));
}

TEST_F(PagesTest, APageThatIsNowhereIsAnError) {
  EXPECT_THROW(window::openPage("doc/none.md", folder.path("bin")), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder.path("opened")));
}

TEST_F(HelpTest, MessagesNameTheInstalledPages) {
  for (const char* made : {"bin", "share/doc/hybrid-slam/doc"})
    std::filesystem::create_directories(folder.path(made));
  const std::string page = folder.write("share/doc/hybrid-slam/doc/gui.md", "# Window\n");
  window::showError(frame, "wrong; see doc/gui.md", folder.path("bin"));
  window::showNotice(frame, "more in doc/gui.md.", folder.path("bin"));
  EXPECT_THAT(dialogs.messages, testing::ElementsAre("wrong; see " + page, "more in " + page + "."));
}

TEST_F(HelpTest, ThePagesOfTheMenuAreThere) {
  for (const window::HelpPage& help : window::helpPages())
    EXPECT_TRUE(std::filesystem::exists(std::string(SOURCE_DIR "/") + help.page)) << help.page;
}

TEST_F(HelpTest, AboutNamesTheVersion) {
  ASSERT_TRUE(opensMenu('H', wxMOD_ALT));
  press('A');
  ASSERT_TRUE(happens([this] { return dialogs.messages.size() == 1; }));
  EXPECT_THAT(dialogs.messages[0], HasSubstr("hybrid-slam-gui " HYBRID_SLAM_VERSION));
}

}  // namespace
}  // namespace hybrid_slam
