#include "study/comparison/Plots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/RandomStream.h"
#include "study/comparison/Report.h"
#include "study/comparison/ReportTables.h"
#include "study/comparison/Svg.h"
#include "study/comparison/XmlCheck.h"

namespace hybrid_slam::comparison {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(XmlCheck, FindsWhatIsWrong) {
  EXPECT_EQ(xmlDefect("<!DOCTYPE html><a b=\"c&amp;\"><d/>x &#160; y<e> </e></a>\n"), "");
  for (const char* xml : {"<a>", "<a></b>", "</a>", "<a b=c></a>", "<a b=\"1\" b=\"2\"/>", "<a>x & y</a>",
                          "<a>x < y</a>", "<a b=\"<\"/>", "<a/>x", "<a b=\"x", "<a", "<a>&x</a>"})
    EXPECT_NE(xmlDefect(xml), "") << xml;
}

size_t count(const std::string& text, const std::string& part) {
  size_t n = 0;
  for (size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++n;
  return n;
}

TEST(Svg, EscapesTextAndAttributes) {
  Svg svg(100, 50);
  svg.text({1, 2}, "a < b & \"c\"");
  svg.circle({1, 2}, 3, "fill:red", "<&>");
  EXPECT_EQ(xmlDefect(svg.str("<\"&>\x01")), "");
  EXPECT_THAT(svg.str("x"), HasSubstr("a &lt; b &amp; &quot;c&quot;"));
}

TEST(Axis, CoversItsRangeWithTicksInEveryKind) {
  for (uint64_t i = 0; i < 300; ++i) {
    RandomStream random(3, i, 0);
    const double low = std::exp(6 * random.gaussian()), high = low * (1 + std::exp(3 * random.gaussian()));
    for (const auto kind : {Axis::Kind::linear, Axis::Kind::tight, Axis::Kind::logarithmic}) {
      if (kind == Axis::Kind::logarithmic && high / low < 20) continue;
      const Axis axis(low, high, kind, 200, 10);
      EXPECT_LE(axis.low(), low * (1 + 1e-9));
      EXPECT_GE(axis.high(), high * (1 - 1e-9));
      EXPECT_NEAR(axis.pixel(axis.low()), 200, 1e-6);
      EXPECT_NEAR(axis.pixel(axis.high()), 10, 1e-6);
      EXPECT_LT(axis.pixel(high), axis.pixel(low));
      ASSERT_GE(axis.ticks().size(), 2u) << low << ".." << high;
      EXPECT_LE(axis.ticks().size(), 12u);
      for (const double tick : axis.ticks()) {
        EXPECT_GE(axis.pixel(tick), 10 - 1e-6);
        EXPECT_LE(axis.pixel(tick), 200 + 1e-6);
      }
    }
  }
}

TEST(Axis, OneValueAloneHasARangeToo) {
  for (const double value : {0.0, 5.0}) {
    const Axis axis(value, value, Axis::Kind::linear, 0, 100);
    EXPECT_TRUE(std::isfinite(axis.pixel(value)));
    EXPECT_GE(axis.ticks().size(), 2u);
  }
}

struct PlotsTest : testing::Test {
  std::vector<Group> groups{{"hybrid", {}, 20}, {"hybrid", {}, 50}, {"general", {}, 20}};
  std::vector<RunResult> results;
  std::vector<GroupSummary> summaries;

  PlotsTest() {
    for (size_t g = 0; g < groups.size(); ++g)
      for (int seed = 1; seed <= 4; ++seed) {
        RunResult r;
        r.run = {g, seed};
        r.status = RunResult::Status::done;
        r[Figure::ate] = 0.1 * seed * static_cast<double>(g + 1);
        r[Figure::cpuTime] = seed;
        r[Figure::success] = seed > 1;
        results.push_back(r);
      }
    summaries = summarise(groups.size(), results);
  }
  static const FigureName& name(Figure f) { return kFigureNames[static_cast<size_t>(f)]; }
};

TEST_F(PlotsTest, NamesStandInTheOrderOfTheirFigures) {
  for (size_t i = 0; i < kFigures; ++i) EXPECT_EQ(static_cast<size_t>(kFigureNames[i].figure), i);
}

TEST_F(PlotsTest, AFigureShowsEveryRunAndNamesItsUnit) {
  const std::string svg = plotFigure(name(Figure::ate), groups, results);
  EXPECT_EQ(xmlDefect(svg), "");
  EXPECT_EQ(count(svg, "<circle"), 12u);
  EXPECT_EQ(count(svg, "<rect"), 3u);
  EXPECT_THAT(svg, HasSubstr("absolute trajectory error, rmse (m)"));
  EXPECT_THAT(svg, HasSubstr(">20 p.<"));
  EXPECT_EQ(plotFigure(name(Figure::rotMean), groups, results), "");
}

TEST_F(PlotsTest, SuccessShowsRatesAndCounts) {
  const std::string svg = plotSuccess(groups, summaries);
  EXPECT_EQ(xmlDefect(svg), "");
  EXPECT_EQ(count(svg, "3 of 4"), 3u);
  EXPECT_EQ(count(svg, "<circle"), 3u);
  EXPECT_EQ(plotSuccess(groups, std::vector<GroupSummary>(3)), "");
}

TEST_F(PlotsTest, ParticlesMakeALineForEachMethod) {
  const std::string svg = plotAgainstParticles(name(Figure::cpuTime), groups, summaries);
  EXPECT_EQ(xmlDefect(svg), "");
  EXPECT_EQ(count(svg, "<circle"), 3u);
  EXPECT_EQ(count(svg, ">hybrid<"), 1u);
  EXPECT_EQ(count(svg, ">general<"), 1u);
  EXPECT_THAT(svg, HasSubstr(">particles<"));
}

TEST_F(PlotsTest, SpreadHasABandAndALineForEachGroupThatRan) {
  const std::vector<SpreadStep> run{{0, {0.1, 0.2, 1}}, {1, {0.2, 0.1, 2}}, {2, {0.3, 0.1, 1}}};
  const SpreadBands bands = spreadBands({run, run}, 10);
  const std::string svg = plotSpread(2, groups, {bands, bands, SpreadBands()});
  EXPECT_EQ(xmlDefect(svg), "");
  EXPECT_EQ(count(svg, "<polygon"), 2u);
  EXPECT_EQ(count(svg, "<polyline"), 2u);
  EXPECT_THAT(svg, HasSubstr("spread of the heading (deg)"));
  EXPECT_EQ(plotSpread(0, groups, std::vector<SpreadBands>(3)), "");
}

TEST_F(PlotsTest, TrajectoriesLieOverReferenceAndPlan) {
  files::Trajectory way;
  for (int i = 0; i < 50; ++i) way.push_back({0.1 * i, {0.2 * i, 1, 0}});
  const simulation::FloorPlan plan({simulation::Wall::straight({0, 0}, {10, 0}),
                                    simulation::Wall::straight({0, 2}, {10, 2}),
                                    simulation::Wall::arc({5, 1}, 0.3, 0, 6)});
  const std::string svg = plotTrajectories(1, groups, {way, way}, way, &plan);
  EXPECT_EQ(xmlDefect(svg), "");
  EXPECT_EQ(count(svg, "<polyline"), 3u + 2u + 1u);
  EXPECT_THAT(svg, HasSubstr(" m</text>"));
  EXPECT_THAT(plotTrajectories(0, groups, {way}, {}, nullptr), HasSubstr("hybrid-20"));
  EXPECT_EQ(plotTrajectories(0, groups, {}, {}, nullptr), "");
}

TEST_F(PlotsTest, TablesAreWellFormedAndNameEveryGroup) {
  const std::string table = summaryTable(groups, summaries, {Figure::ate, Figure::rotMean}, true);
  EXPECT_EQ(xmlDefect(table), "");
  EXPECT_EQ(count(table, "<tr>"), 4u);
  EXPECT_THAT(table, HasSubstr("3&#160;of&#160;4 <small>"));
  EXPECT_THAT(table, Not(HasSubstr("rotation")));  // no run has it
  const std::string paired = pairedTable(groups, summaries);
  EXPECT_EQ(xmlDefect(paired), "");
  EXPECT_EQ(count(paired, "<tr>"), 3u);
  EXPECT_THAT(paired, HasSubstr("<td>3 <small>"));  // general-20 has three times the errors of hybrid-20
  EXPECT_EQ(failureTable(groups, results), "");
  results[0].status = RunResult::Status::failed;
  results[0].error = "a < b";
  EXPECT_THAT(failureTable(groups, results), HasSubstr("a &lt; b"));
}

TEST(Base64, OfRfc4648) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

}  // namespace
}  // namespace hybrid_slam::comparison
