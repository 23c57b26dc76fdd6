#include "window/view/FilterScene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace hybrid_slam::window {
namespace {

/// A free room of 4 m x 2 m around (10, 5), with walls one cell thick and unknown cells outside.
FilterSnapshot room() {
  FilterSnapshot filter;
  filter.method = "hybrid";
  filter.map = {60, 40, 0.1, 7, 3, std::vector<uint8_t>(60 * 40, 127)};
  for (int y = 10; y < 30; ++y)
    for (int x = 10; x < 50; ++x)
      filter.map.grey[static_cast<size_t>(60 * y + x)] = x == 10 || x == 49 || y == 10 || y == 29 ? 0 : 255;
  filter.map.grey[60 * 12 + 12] = 0;  // a pillar near the upper left corner
  filter.path = {{9, 5, 0}, {9.5, 5, 0}};
  DatabaseLine line;
  line.start = {8, 5.95}, line.end = {12, 5.95};
  filter.lines = {line};
  ScanLine matched, other;
  matched.isMatched = true;
  matched.segment.start = {11.95, 4.2}, matched.segment.end = {11.95, 5.8};
  other.segment.start = {9, 4.05}, other.segment.end = {11, 4.05};
  filter.scanLines = {matched, other};
  filter.particles = {{{11, 5.3, 0}, 0}, {{11, 4.7, 0}, 0}};
  filter.ellipse = {{11, 5}, 0.2, 0.1, 0};
  filter.dominatingDirection = 0;
  return filter;
}

TEST(MapView, RoundTripBetweenPointsAndPixels) {
  const MapView view{3, -2, 25};
  const PictureSize size{640, 480};
  EXPECT_NEAR(view.toPicture(3, -2, size).x, 320, 1e-9);
  EXPECT_NEAR(view.toPicture(3, -1, size).y, 240 - 25, 1e-9);  // up in the map is up on the screen
  const auto back = view.toMap(100, 50, size);
  const auto there = view.toPicture(back.x, back.y, size);
  EXPECT_NEAR(there.x, 100, 1e-9);
  EXPECT_NEAR(there.y, 50, 1e-9);
}

TEST(MapView, TheWholeMapIsInThePicture) {
  const FilterSnapshot filter = room();
  for (const PictureSize size : {PictureSize{800, 300}, PictureSize{300, 800}}) {
    const MapView view = wholeMap(filter.map, {}, size);
    const auto corner = view.toPicture(filter.map.left, filter.map.top(), size);
    const auto opposite = view.toPicture(filter.map.right(), filter.map.bottom, size);
    EXPECT_GE(corner.x, -1e-9);
    EXPECT_GE(corner.y, 54) << "three lines of the caption";
    EXPECT_LE(opposite.x, size.width + 1e-9);
    EXPECT_LE(opposite.y, size.height);
  }
}

TEST(FilterScene, HasTheRequestedLayers) {
  const FilterSnapshot filter = room();
  const PictureSize size{600, 400};
  const auto scene = [&](const Layers& layers) {
    return filterScene(filter, mapPlane(filter.map), wholeMap(filter.map, {}, size), layers, size);
  };
  const auto all = scene({});
  for (const char* const name : {"grid", "lines", "path", "scan lines, matched", "scan lines, not matched",
                                 "particles", "uncertainty", "robot", "dominating direction"})
    EXPECT_TRUE(all->getByName(name)) << name;
  const auto none = scene({false, false, false, false, false, false});
  for (const char* const name : {"lines", "path", "scan lines, matched", "particles", "uncertainty"})
    EXPECT_FALSE(none->getByName(name)) << name;
  EXPECT_TRUE(none->getByName("grid"));
  EXPECT_TRUE(none->getByName("robot"));
}

TEST(Caption, HasTheMatchesDrawnAndTheVerdict) {
  using testing::ElementsAre;
  FilterSnapshot filter = room();
  filter.updates = 7;
  filter.step.ess = 0.5;
  filter.step.linesMatched = 2;  // what is drawn counts
  EXPECT_THAT(captionOf(filter),
              ElementsAre("hybrid: 7 updates, ESS 50 %", "1 lines; of the scan: 1 of 2 match"));
  filter.verdict.emplace().level = run::Verdict::Level::doubtful;
  EXPECT_THAT(captionOf(filter), ElementsAre("hybrid: 7 updates, ESS 50 %",
                                             "1 lines; of the scan: 1 of 2 match", "so far doubtful"));
  filter.place = Place{false, false, 12};
  EXPECT_THAT(captionOf(filter), ElementsAre("hybrid: 7 updates", "start unknown: 12 hypotheses"));
}

TEST(FilterScene, WhileThePlaceIsUnknownThereIsNoEllipse) {
  FilterSnapshot filter = room();
  const PictureSize size{600, 400};
  for (const bool isKnown : {false, true}) {
    filter.place = Place{isKnown, false, 12};
    const auto scene = filterScene(filter, mapPlane(filter.map), wholeMap(filter.map, {}, size), {}, size);
    EXPECT_EQ(scene->getByName("uncertainty") != nullptr, isKnown);
    EXPECT_TRUE(scene->getByName("particles")) << "the places that are possible";
  }
}

TEST(FilterScene, AnEmptyMapGivesNoPlane) {
  EXPECT_FALSE(mapPlane({}));
  const FilterSnapshot nothing;
  EXPECT_TRUE(filterScene(nothing, nullptr, {}, {}, {200, 100}));
}

/// Renders the picture off-screen.
TEST(FilterScene, ThePictureShowsEverythingInItsPlace) {
  const FilterSnapshot filter = room();
  const PictureSize size{600, 481};  // odd, so that the path is in the middle of a row of pixels
  mrpt::img::CImage picture;
  try {
    picture = pictureOf(filter, size, {});
  } catch (const std::exception& e) {
    GTEST_SKIP() << "no OpenGL without a screen: " << e.what();
  }
  ASSERT_EQ(picture.getWidth(), 600u);
  ASSERT_EQ(picture.getHeight(), 481u);
  const MapView view = wholeMap(filter.map, {}, size);
  const auto colourAt = [&](double x, double y) {  // red, green, blue
    const auto at = view.toPicture(x, y, size);
    std::vector<int> colour;
    for (const unsigned channel : {2u, 1u, 0u})
      colour.push_back(
          picture.at<uint8_t>(static_cast<unsigned>(at.x), static_cast<unsigned>(at.y), channel));
    return colour;
  };
  using testing::ElementsAre;
  EXPECT_THAT(colourAt(7.5, 3.5), ElementsAre(127, 127, 127)) << "unknown";
  EXPECT_THAT(colourAt(9, 4.5), ElementsAre(255, 255, 255)) << "free";
  EXPECT_THAT(colourAt(8.05, 5), ElementsAre(0, 0, 0)) << "a wall";
  EXPECT_THAT(colourAt(8.25, 5.75), ElementsAre(0, 0, 0)) << "the pillar: the picture is upright";
  EXPECT_THAT(colourAt(9.2, 5), ElementsAre(220, 0, 0)) << "the path";
  EXPECT_THAT(colourAt(10, 5.95), ElementsAre(0, 150, 0)) << "the line database";
  EXPECT_THAT(colourAt(11.95, 4.5), ElementsAre(0, 70, 230)) << "a matched line";
  EXPECT_THAT(colourAt(10, 4.05), ElementsAre(245, 130, 0)) << "one that is not";
  EXPECT_THAT(colourAt(9.5, 5.25), ElementsAre(80, 180, 255)) << "the robot";
  EXPECT_THAT(colourAt(11 + 0.6, 5), ElementsAre(150, 0, 180)) << "three sigma";
  EXPECT_THAT(colourAt(11.02, 5.3), ElementsAre(220, 0, 0)) << "a particle";
}

/// The pane is as narrow as in the smallest window (800 pixels), and its width is no multiple of four.
TEST(FilterScene, TheCaptionOfANarrowPaneEndsBeforeTheCompass) {
  FilterSnapshot filter = room();
  filter.method = "general";
  filter.updates = 99999;
  filter.step.ess = 1;
  filter.lines.resize(999, filter.lines.at(0));
  filter.scanLines.resize(99, filter.scanLines.at(0));
  Layers layers;
  layers.lines = false;  // no compass
  constexpr unsigned kWidth = 390, kHeight = 260, kCompass = 61, kLine = 18;
  std::vector<FilterSnapshot> states(4, filter);
  states[0].verdict.emplace().level = run::Verdict::Level::consistent;
  states[1].place = Place{false, false, 999};  // the start is searched for
  states[2].place = Place{true, true, 1};      // localised
  states[3].place = Place{false, true, 999};   // lost
  for (const FilterSnapshot& state : states) {
    mrpt::img::CImage picture;
    try {
      picture = pictureOf(state, {kWidth, kHeight}, layers);
    } catch (const std::exception& e) {
      GTEST_SKIP() << "no OpenGL without a screen: " << e.what();
    }
    ASSERT_EQ(picture.getWidth(), kWidth);
    const std::vector<std::string> caption = captionOf(state);
    std::vector<size_t> text(caption.size());
    size_t beside = 0;
    for (unsigned y = 0; y < 60; ++y)
      for (unsigned x = 0; x < kWidth; ++x) {
        const int grey = picture.at<uint8_t>(x, y, 0);
        if (grey >= 100 && grey <= 155) continue;
        if (x >= kWidth - kCompass) ++beside;
        if (x < kWidth - kCompass && y / kLine < text.size()) ++text[y / kLine];
      }
    for (size_t i = 0; i < text.size(); ++i) EXPECT_GT(text[i], 50u) << caption[i];
    EXPECT_EQ(beside, 0u) << testing::PrintToString(caption);
  }
}

}  // namespace
}  // namespace hybrid_slam::window
