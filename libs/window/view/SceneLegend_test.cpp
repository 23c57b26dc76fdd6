#include "window/view/SceneLegend.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hybrid_slam::window {
namespace {

using testing::ElementsAre;

FilterSnapshot hybrid() {
  FilterSnapshot filter;
  filter.map = {1, 1, 0.1, 0, 0, {255}};
  filter.path = {{0, 0, 0}, {1, 0, 0}};
  filter.particles = {{{1, 0, 0}, 0}};
  filter.lines.resize(1);
  filter.scanLines.resize(2);
  filter.scanLines[0].isMatched = true;
  return filter;
}

std::vector<std::string> labels(const FilterSnapshot& filter, const Layers& layers = {}) {
  std::vector<std::string> all;
  for (const LegendEntry& entry : legendOf(filter, layers)) all.push_back(entry.label);
  return all;
}

TEST(SceneLegend, NamesWhatIsDrawn) {
  FilterSnapshot filter = hybrid();
  EXPECT_THAT(labels(filter), ElementsAre("occupied", "free", "path", "particles", "robot", "3 sigma",
                                          "lines", "matched", "unmatched"));
  EXPECT_THAT(labels(filter, {false, false, false, false, false}), ElementsAre("occupied", "free", "robot"));
  EXPECT_THAT(labels(filter, {false, false, false, true, false}),
              ElementsAre("occupied", "free", "robot", "matched", "unmatched"));
  filter.lines.clear(), filter.scanLines.clear();
  EXPECT_THAT(labels(filter), ElementsAre("occupied", "free", "path", "particles", "robot", "3 sigma"))
      << "without lines";
  filter.path.clear();
  filter.place = Place{false, false, 12};
  EXPECT_THAT(labels(filter), ElementsAre("occupied", "free", "particles")) << "the place is unknown";
}

TEST(SceneLegend, TheScaleBarIsRoundAndAtMost80Pixels) {
  EXPECT_DOUBLE_EQ(scaleBarLength(80), 1);
  EXPECT_DOUBLE_EQ(scaleBarLength(81), 0.5);
  EXPECT_DOUBLE_EQ(scaleBarLength(8), 10);
  EXPECT_DOUBLE_EQ(scaleBarLength(3), 20);
  EXPECT_DOUBLE_EQ(scaleBarLength(0.1), 500);
}

TEST(SceneLegend, WrapsInANarrowPicture) {
  const FilterSnapshot filter = hybrid();
  const LegendLayout wide = legendLayout(filter, {}, {1600, 1200});
  const LegendLayout narrow = legendLayout(filter, {}, {390, 300});
  ASSERT_EQ(narrow.places.size(), narrow.entries.size());
  EXPECT_EQ(wide.places.back().y, wide.places.front().y);
  EXPECT_GT(narrow.height, wide.height);
  EXPECT_LT(narrow.height, 60) << "three rows";
  for (size_t i = 0; i < narrow.places.size(); ++i) {
    EXPECT_LT(narrow.places[i].x, 390 - 14 - 6 * static_cast<double>(narrow.entries[i].label.size()));
    EXPECT_LT(narrow.places[i].y, narrow.height);
    const bool isInSameRow = i > 0 && narrow.places[i].y == narrow.places[i - 1].y;
    EXPECT_TRUE(!isInSameRow || narrow.places[i].x > narrow.places[i - 1].x);
  }
  EXPECT_EQ(legendRoom({}, {390, 300}), narrow.height);
  FilterSnapshot withoutLines = filter;
  withoutLines.lines.clear(), withoutLines.scanLines.clear();
  EXPECT_LT(legendLayout(withoutLines, {}, {390, 300}).height, narrow.height);
  Layers hidden;
  hidden.legend = false;
  EXPECT_EQ(legendLayout(filter, hidden, {390, 300}).height, 0);
}

}  // namespace
}  // namespace hybrid_slam::window
