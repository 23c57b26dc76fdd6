/// Search and reset in Parameters, with real keys and the mouse.
#include <wx/display.h>
#include <wx/timer.h>

#include <string>
#include <utility>

#include "KeysTest.h"

namespace hybrid_slam {
namespace {

class ParametersTest : public KeysTest {
 protected:
  void SetUp() override {
    KeysTest::SetUp();
    openLog();
    dialog = new window::ParametersDialog(frame, *frame->settings());
    dialog->Show();
    ASSERT_TRUE(happens([this] { return dialog->IsActive(); }));
  }
  void TearDown() override {
    delete dialog;
    KeysTest::TearDown();
  }
  void type(const std::string& text) {
    wxUIActionSimulator().Text(text.c_str());
    wxYield();
  }
  /// Clicks on the name of a key.
  void select(const char* name) {
    wxPropertyGrid* const grid = dialog->grid();
    const wxPGProperty* const key = grid->GetProperty(name);
    grid->EnsureVisible(name);
    const wxRect row = grid->GetPropertyRect(key, key);
    pointAt(grid, grid->CalcScrolledPosition(wxPoint(row.x + 60, row.y + row.height / 2)));
    wxUIActionSimulator().MouseClick();
    ASSERT_TRUE(happens([&] { return grid->GetSelection() == key; })) << name;
  }
  bool isShown(const char* name) { return !dialog->grid()->GetProperty(name)->HasFlag(wxPG_PROP_HIDDEN); }
  bool isMarked(const char* name) { return dialog->grid()->GetProperty(name)->HasFlag(wxPG_PROP_MODIFIED); }
  std::string value(const char* name) { return dialog->grid()->GetPropertyValueAsString(name).utf8_string(); }

  window::ParametersDialog* dialog = nullptr;
};

TEST_F(ParametersTest, TheSearchShowsTheKeysThatMatch) {
  EXPECT_TRUE(wxDisplay(0u).GetClientArea().Contains(dialog->GetScreenRect()));
  ASSERT_TRUE(isShown("particle_filter.seed"));
  type("ess_thr");
  EXPECT_TRUE(happens([this] { return !isShown("particle_filter.seed"); }))
      << "the keyboard is in the search";
  EXPECT_TRUE(isShown("particle_filter.ess_threshold"));
  EXPECT_FALSE(isShown("run.rawlog"));
  screenshot("parameters-search");
  press('A', wxMOD_CONTROL);
  type("CELL grid");  // of a description, and a section
  EXPECT_TRUE(happens([this] { return isShown("grid.resolution"); }));
  EXPECT_FALSE(isShown("particle_filter.ess_threshold"));
  press('A', wxMOD_CONTROL);
  press(WXK_DELETE);
  EXPECT_TRUE(happens([this] { return isShown("particle_filter.seed") && isShown("run.rawlog"); }));
  EXPECT_TRUE(dialog->changes().empty());
}

TEST_F(ParametersTest, AKeyGetsItsDefault) {
  const int standard = frame->settings()->defaults()->configuration.filter.filter.particles;
  ASSERT_NE(standard, 8);
  EXPECT_TRUE(isMarked("particle_filter.particles"));
  EXPECT_FALSE(isMarked("particle_filter.seed"));
  EXPECT_FALSE(isMarked("run.rawlog")) << "the log is no setting to reset";
  EXPECT_FALSE(dialog->resetButton()->IsEnabled()) << "no key is selected";
  select("particle_filter.particles");
  ASSERT_TRUE(happens([this] { return dialog->resetButton()->IsEnabled(); }));
  screenshot("parameters-selected");
  click(dialog->resetButton());
  EXPECT_TRUE(happens([&] { return value("particle_filter.particles") == std::to_string(standard); }));
  EXPECT_FALSE(isMarked("particle_filter.particles"));
  EXPECT_FALSE(dialog->resetButton()->IsEnabled());
  EXPECT_THAT(dialog->resets(), testing::ElementsAre("particle_filter.particles"));
  EXPECT_TRUE(dialog->changes().empty());

  frame->applyChanges(dialog->changes(), dialog->resets());
  auto& now = *frame->settings();
  EXPECT_EQ(now.configuration.filter.filter.particles, standard);
  EXPECT_FALSE(now.configuration.source.keyExists("particle_filter", "particles")) << "later logs choose";
  EXPECT_TRUE(now.configuration.source.keyExists("particle_filter", "proposal")) << "the others stay";
  EXPECT_EQ(now.configuration.run.rawlog, log);
}

TEST_F(ParametersTest, AKeyThatIsSetAfterItsResetIsAChange) {
  select("particle_filter.particles");
  click(dialog->resetButton());
  ASSERT_TRUE(happens([this] { return !isMarked("particle_filter.particles"); }));
  EXPECT_TRUE(dialog->grid()->ChangePropertyValue("particle_filter.particles", "12"));
  EXPECT_TRUE(isMarked("particle_filter.particles"));
  EXPECT_TRUE(dialog->grid()->ChangePropertyValue("particle_filter.seed", "7"));
  EXPECT_TRUE(isMarked("particle_filter.seed"));
  frame->applyChanges(dialog->changes(), dialog->resets());
  EXPECT_EQ(frame->settings()->configuration.filter.filter.particles, 12);
}

TEST_F(ParametersTest, AllKeysGetTheirDefaults) {
  ASSERT_TRUE(dialog->grid()->ChangePropertyValue("particle_filter.seed", "7"));
  click(dialog->resetAllButton());
  ASSERT_TRUE(happens([this] { return !dialog->resetAllButton()->IsEnabled(); }));
  for (const char* key : {"particle_filter.particles", "particle_filter.seed", "grid.resolution"})
    EXPECT_FALSE(isMarked(key)) << key;
  frame->applyChanges(dialog->changes(), dialog->resets());
  const auto standard = frame->settings()->defaults();
  EXPECT_EQ(window::Settings(*frame->settings()).configuration.text(),
            window::Settings(*standard).configuration.text());
  EXPECT_EQ(frame->settings()->configuration.run.rawlog, log) << "it stays open";
}

/// Searches for the seed in the open dialog, types a value over its own, and clicks on OK. Each step waits
/// for the one before.
class SeedTypist : public wxTimer {
 public:
  SeedTypist(Dialogs& dialogs, std::string value) : dialogs_(dialogs), value_(std::move(value)) {
    dialogs_.left = "Parameters";
    Start(100);
  }
  void Notify() override {
    auto* const dialog = dynamic_cast<window::ParametersDialog*>(dialogs_.open);
    if (!dialog || isActing_) return;
    if (++ticks_ > 400) return dialog->EndModal(wxID_CANCEL);  // else the test would not end
    isActing_ = true;                                          // the simulator may run the window
    if (isReadyFor(step_, *dialog)) act(step_++, *dialog);
    isActing_ = false;
  }

 private:
  bool isReadyFor(int step, window::ParametersDialog& dialog) const {
    wxPropertyGrid* const grid = dialog.grid();
    if (step == 0) return dialog.IsActive();
    if (step == 1) return grid->GetProperty("run.rawlog")->HasFlag(wxPG_PROP_HIDDEN);
    if (step == 2) return grid->GetEditorControl() && wxWindow::FindFocus() == grid->GetEditorControl();
    return step == 3 && grid->GetPropertyValueAsString(kKey).utf8_string() == value_;
  }
  void act(int step, window::ParametersDialog& dialog) {
    wxUIActionSimulator user;
    wxPropertyGrid* const grid = dialog.grid();
    if (step == 0) user.Text("seed");
    if (step == 1) {
      const wxRect row = grid->GetPropertyRect(grid->GetProperty(kKey), grid->GetProperty(kKey));
      const wxPoint place(grid->GetSplitterPosition() + 40, row.y + row.height / 2);
      user.MouseMove(grid->ClientToScreen(grid->CalcScrolledPosition(place)));
      user.MouseClick();
    }
    if (step == 2) {
      user.Char('A', wxMOD_CONTROL);
      user.Text(value_.c_str());
      user.Char(WXK_RETURN);
    }
    if (step == 3) {
      const wxRect ok = wxWindow::FindWindowById(wxID_OK, &dialog)->GetScreenRect();
      user.MouseMove(ok.GetPosition() + wxPoint(ok.width / 2, ok.height / 2));
      user.MouseClick();
    }
  }

  static constexpr const char* kKey = "particle_filter.seed";
  Dialogs& dialogs_;
  std::string value_;
  int step_ = 0, ticks_ = 0;
  bool isActing_ = false;
};

TEST_F(KeysTest, ATypedParameterRestartsTheReplay) {
  openAt(20);
  ASSERT_NE(frame->settings()->configuration.filter.filter.seed, 77u);
  const SeedTypist typist(dialogs, "77");
  press(WXK_F4);
  EXPECT_TRUE(stands(State::paused, 0)) << "from the start";
  EXPECT_EQ(frame->settings()->configuration.filter.filter.seed, 77u);
  EXPECT_TRUE(dialogs.messages.empty());
}

}  // namespace
}  // namespace hybrid_slam
