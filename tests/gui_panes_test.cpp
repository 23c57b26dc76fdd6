/// The panes besides the map: legend, scale bar, the cell under the mouse pointer; the smallest window.
#include "KeysTest.h"
#include "window/view/SceneLegend.h"

namespace hybrid_slam {
namespace {

class PanesTest : public KeysTest {
 protected:
  const window::MapCanvas& pane() { return *frame->replay()->canvas(0); }
  size_t strip(const wxImage& screen) { return count(screen, pane(), 80, 80, 80); }
  size_t ellipse(const wxImage& screen) { return count(screen, pane(), 150, 0, 180); }
  /// Pixels of the longest white run in the rows of the pane's legend.
  int longestWhiteRun(const wxImage& screen) {
    const window::LegendLayout layout = legendLayout(*pane().shown(), {}, pane().size());
    const int below = pane().size().height, top = below - static_cast<int>(layout.height);
    int longest = 0;
    for (int y = top; y < below; ++y)
      for (int x = 0, run = 0; x < pane().size().width; ++x) {
        const wxPoint at = onScreen({pane().ClientToScreen(wxPoint(x, y)), wxSize(1, 1)}).GetTopLeft();
        run = screen.GetRed(at.x, at.y) > 240 && screen.GetBlue(at.x, at.y) > 240 ? run + 1 : 0;
        longest = std::max(longest, run);
      }
    return longest;
  }
  /// Points at a pixel whose cell is darker than 76 (occupied), or 127 (unknown). @return its place
  mrpt::math::TPoint2D pointAtCell(bool isOccupied) {
    const window::MapImage& map = pane().shown()->map;
    for (int y = 0; y < pane().size().height; ++y)
      for (int x = 0; x < pane().size().width; ++x) {
        const auto place = pane().view().toMap(x + 0.5, y + 0.5, pane().size());
        const double column = (place.x - map.left) / map.resolution;
        const double row = (map.top() - place.y) / map.resolution;
        if (column < 0 || row < 0 || column >= map.width || row >= map.height) continue;
        const int grey =
            map.grey[static_cast<size_t>(row) * static_cast<size_t>(map.width) + static_cast<size_t>(column)];
        if (isOccupied ? grey >= 76 : grey != 127) continue;
        pointAt(frame->replay()->canvas(0), {x, y});
        return place;
      }
    ADD_FAILURE() << "no such cell";
    return {};
  }
};

TEST_F(PanesTest, TheLegendAndTheScaleBarCanBeHidden) {
  openAt(40);
  wxImage shown;
  EXPECT_TRUE(screenShows("legend", [&](const wxImage& screen) {
    shown = screen;
    return strip(screen) > 4000;
  }));
  const double scale = pane().view().scale;
  EXPECT_NEAR(longestWhiteRun(shown), window::scaleBarLength(scale) * scale, 4) << "as long as it says";
  press('7', wxMOD_CONTROL);
  EXPECT_TRUE(happens([&] { return pane().view().scale > scale; })) << "the map takes its room";
  EXPECT_TRUE(screenShows("no-legend", [this](const wxImage& screen) { return strip(screen) < 1000; }));
  press('7', wxMOD_CONTROL);
  EXPECT_TRUE(screenShows("legend-again", [this](const wxImage& screen) { return strip(screen) > 4000; }));
}

TEST_F(PanesTest, TheEllipseOfThePoseCanBeHidden) {
  openAt(40);
  press('7', wxMOD_CONTROL);  // else its entry would be counted
  EXPECT_TRUE(screenShows(
      "ellipse", [this](const wxImage& screen) { return strip(screen) < 1000 && ellipse(screen) > 5; }));
  press('6', wxMOD_CONTROL);
  EXPECT_TRUE(screenShows("no-ellipse", [this](const wxImage& screen) { return ellipse(screen) == 0; }));
}

TEST_F(PanesTest, TheStatusBarSaysWhatIsUnderTheMousePointer) {
  openAt(40);
  const auto place = pointAtCell(true);
  const auto saysOccupied = [this] {
    const size_t at = status(2).find("occupied ");
    return at != std::string::npos && std::stod(status(2).substr(at + 9)) > 0.69;
  };
  EXPECT_TRUE(happens(saysOccupied)) << status(2);
  double x = 0, y = 0;
  ASSERT_EQ(std::sscanf(status(2).c_str(), "x %lf m, y %lf m", &x, &y), 2) << status(2);
  const double pixel = 1 / pane().view().scale;
  EXPECT_NEAR(x, place.x, pixel);
  EXPECT_NEAR(y, place.y, pixel);
  screenshot("cursor");
  pointAtCell(false);
  EXPECT_TRUE(happens([this] { return status(2).find(": unknown") != std::string::npos; })) << status(2);
  pointAt(frame->replay()->stepButton(), {5, 5});
  EXPECT_TRUE(happens([this] { return status(2).empty(); })) << status(2);
}

TEST_F(PanesTest, TheTooltipOfTheEventListIsTheWholeLineUnderTheMousePointer) {
  openAt(40);
  const window::EventList* const list = frame->replay()->events();
  ASSERT_GT(list->GetCount(), 1u);
  for (const int y : {4, 30}) {
    const int line = list->HitTest(wxPoint(20, y));
    ASSERT_NE(line, wxNOT_FOUND);
    pointAt(const_cast<window::EventList*>(list), {20, y});
    EXPECT_TRUE(happens([&] {
      return list->GetToolTipText() == list->GetString(static_cast<unsigned>(line));
    })) << list->GetToolTipText();
  }
  EXPECT_NE(list->HitTest(wxPoint(20, 4)), list->HitTest(wxPoint(20, 30)));
}

/// The pages' own controls: inside the page, beside each other, and large enough for their texts.
TEST_F(PanesTest, TheSmallestWindowHasRoomForItsControls) {
  openAt(40);
  frame->SetSize(frame->FromDIP(wxSize(800, 560)));
  for (const int page : {window::kReplayPage, window::kLivePage}) {
    menu(page);
    screenshot(page == window::kReplayPage ? "small-replay" : "small-live");
    const wxWindow* const panel =
        page == window::kReplayPage ? static_cast<wxWindow*>(frame->replay()) : frame->live();
    std::vector<wxRect> before;
    for (const wxWindow* control : panel->GetChildren()) {
      const bool isMap = dynamic_cast<const window::MapCanvas*>(control) != nullptr;
      EXPECT_GE(control->GetSize().y, isMap ? frame->FromDIP(200) : 0) << "a map";
      const wxRect area = control->GetRect();
      EXPECT_TRUE(wxRect(panel->GetClientSize()).Contains(area)) << control->GetLabel();
      for (const wxRect& other : before) EXPECT_FALSE(other.Intersects(area)) << control->GetLabel();
      before.push_back(area);
      const bool isText = dynamic_cast<const wxTextCtrl*>(control) != nullptr;
      EXPECT_GE(area.width, isText ? frame->FromDIP(100) : 0) << "a text field";
      const bool isLabel = dynamic_cast<const wxStaticText*>(control) != nullptr;
      EXPECT_GE(area.width, isLabel ? control->GetTextExtent(control->GetLabel()).x : 0)
          << control->GetLabel();
    }
  }
}

TEST_F(PanesTest, TheButtonsHaveRoomForTheirNamesWhileALogPlays) {
  openAt(10);
  for (int i = 0; i < 2; ++i) press(WXK_DOWN, wxMOD_CONTROL);  // slow
  press(WXK_SPACE);
  ASSERT_TRUE(happens([this] { return now().state == State::playing; }));
  size_t buttons = 0;
  const auto isPlaying = [this] {
    for (const wxWindow* control : frame->replay()->GetChildren())
      if (control->GetLabel() == "Pause") return true;
    return false;
  };
  ASSERT_TRUE(happens(isPlaying));
  screenshot("playing");
  for (const wxWindow* control : frame->replay()->GetChildren())
    if (dynamic_cast<const wxButton*>(control)) {
      EXPECT_GE(control->GetSize().x, control->GetBestSize().x) << control->GetLabel();
      ++buttons;
    }
  EXPECT_EQ(buttons, 4u);
}

/// The texts of a plot stand above it or in it, those of its axis one above the other; none reaches the next.
TEST_F(PanesTest, AWindowOf800PixelsHasRoomForTheTextsOfThePlots) {
  openAt(40);
  frame->SetSize(frame->FromDIP(wxSize(800, 560)));
  ASSERT_TRUE(happens([this] { return frame->GetClientSize().x <= frame->FromDIP(800); }));
  for (const int page : {window::kReplayPage, window::kLivePage}) {
    menu(page);
    screenshot(page == window::kReplayPage ? "plots-replay" : "plots-live");
    const wxWindow* const panel =
        page == window::kReplayPage ? static_cast<wxWindow*>(frame->replay()) : frame->live();
    const window::PlotPanel* plots = nullptr;
    for (const wxWindow* child : panel->GetChildren())
      if (const auto* const found = dynamic_cast<const window::PlotPanel*>(child)) plots = found;
    ASSERT_NE(plots, nullptr);
    const auto widthOf = [&](const std::string& text) { return plots->GetTextExtent(text).x; };
    const double gap = frame->FromDIP(3);
    double end = 0;  // of the plot before
    for (size_t i = 0; i < window::PlotPanel::kCount; ++i) {
      const wxRect2DDouble area = plots->plotArea(i);
      EXPECT_GE(area.GetLeft(), end + gap) << i;
      end = area.GetRight();
      for (const std::string& text :
           {window::PlotPanel::titles().at(i), std::string("0.002"), std::string("100000 s")})
        EXPECT_LE(widthOf(text) + 2 * gap, area.m_width) << text;
      EXPECT_GE(area.m_height, 3 * plots->GetCharHeight()) << "a title and the ends of the axes";
    }
    const wxRect2DDouble names = plots->namesArea();
    EXPECT_GE(names.GetLeft(), end + gap);
    EXPECT_LE(names.GetRight(), plots->GetClientSize().x);
    for (const char* method : {"hybrid", "general", "linemap", "ortho", "stock"})
      EXPECT_LE(widthOf(method), names.m_width) << method;
  }
}

}  // namespace
}  // namespace hybrid_slam
