/// Search and reset in Parameters, with real keys and the mouse.
#include <wx/display.h>

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

}  // namespace
}  // namespace hybrid_slam
