#include "study/comparison/Plots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hybrid_slam::comparison {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

size_t count(const std::string& text, const std::string& part) {
  size_t n = 0;
  for (size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++n;
  return n;
}

struct PlotsTest : testing::Test {
  std::vector<Group> groups{{"hybrid", {}, 20}, {"hybrid", {}, 50}, {"general", {}, 20}};
  std::vector<RunResult> results;
  std::vector<GroupSummary> summaries;
  Gnuplot gnuplot;

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
    summaries = groupSummaries(groups.size(), results);
  }
  static const FigureName& name(Figure f) { return kFigureNames[static_cast<size_t>(f)]; }
  std::string drawn(const Plot& plot) {
    const std::string svg = gnuplot.draw({plot});
    EXPECT_EQ(gnuplot.error(), "");
    EXPECT_THAT(svg, HasSubstr("aria-label=\"" + plot.description + "\""));
    return svg;
  }
};

TEST_F(PlotsTest, NamesStandInTheOrderOfTheirFigures) {
  for (size_t i = 0; i < kFigures; ++i) EXPECT_EQ(static_cast<size_t>(kFigureNames[i].figure), i);
}

TEST_F(PlotsTest, AMethodKeepsItsColour) {
  EXPECT_THAT(plotColours(groups), ElementsAre(0x0072b2, 0x0072b2, 0xd55e00));
}

TEST_F(PlotsTest, AFigureShowsEveryRunAndNamesItsUnit) {
  const Plot plot = plotFigure(name(Figure::ate), groups, results);
  EXPECT_EQ(plot.description, "absolute trajectory error, rmse (m)");
  EXPECT_THAT(plot.script, HasSubstr("$boxes << EOD\n0 0.175 0.25 0.325 29362\n1 0.35 0.5 0.65 29362\n"));
  EXPECT_THAT(plot.script, HasSubstr("set ylabel 'm'\n"));
  const std::string svg = drawn(plot);
  EXPECT_EQ(count(svg, "<use xlink:href='#p1-gpPt6' transform="), 12u);
  EXPECT_EQ(count(svg, ">20 p.<"), 2u);
  EXPECT_EQ(plotFigure(name(Figure::rotMean), groups, results).script, "");
}

TEST_F(PlotsTest, AGroupWithoutTheFigureIsMarked) {
  for (RunResult& r : results)
    if (r.run.group == 1) r[Figure::ate].reset();
  EXPECT_EQ(count(drawn(plotFigure(name(Figure::ate), groups, results)), ">no run<"), 1u);
}

TEST_F(PlotsTest, FiguresDecadesApartHaveALogarithmicAxis) {
  EXPECT_THAT(plotFigure(name(Figure::ate), groups, results).script, Not(HasSubstr("logscale")));
  results[0][Figure::ate] = 30;
  const Plot plot = plotFigure(name(Figure::ate), groups, results);
  EXPECT_THAT(plot.script, HasSubstr("logscale y"));
  const std::string svg = drawn(plot);
  for (const char* tick : {">0.2<", ">0.5<", ">1<", ">20<"}) EXPECT_THAT(svg, HasSubstr(tick));
  results[0][Figure::ate] = 0;
  EXPECT_THAT(plotFigure(name(Figure::ate), groups, results).script, Not(HasSubstr("logscale")));
}

TEST_F(PlotsTest, SuccessShowsRatesAndCounts) {
  const Plot plot = plotSuccess(groups, summaries);
  EXPECT_EQ(plot.description, "success rates");
  EXPECT_THAT(plot.script, HasSubstr("$rates << EOD\n75 0 "));
  EXPECT_EQ(count(drawn(plot), ">3 of 4<"), 3u);
  EXPECT_EQ(plotSuccess(groups, std::vector<GroupSummary>(3)).script, "");
}

TEST_F(PlotsTest, ParticlesMakeALineForEachMethod) {
  const Plot plot = plotAgainstParticles(name(Figure::cpuTime), groups, summaries);
  EXPECT_EQ(plot.description, "CPU time (s) against particles");
  EXPECT_THAT(plot.script, HasSubstr("$line0 << EOD\n20 2.5 1.75 3.25\n50 2.5 1.75 3.25\nEOD\n"));
  const std::string svg = drawn(plot);
  EXPECT_EQ(count(svg, ">hybrid</text>"), 1u);
  EXPECT_EQ(count(svg, ">general</text>"), 1u);
  EXPECT_THAT(svg, HasSubstr(">particles<"));
  EXPECT_EQ(plotAgainstParticles(name(Figure::rotMean), groups, summaries).script, "");
}

TEST_F(PlotsTest, SpreadHasABandAndALineForEachGroupThatRan) {
  const std::vector<SpreadStep> run{{0, {0.1, 0.2, 1}}, {1, {0.2, 0.1, 2}}, {2, {0.3, 0.1, 1}}};
  const SpreadBands bands = spreadBands({run, run}, 10);
  const Plot plot = plotSpread(2, groups, {bands, bands, SpreadBands()});
  EXPECT_EQ(plot.description, "spread of the heading (deg)");
  EXPECT_EQ(count(plot.script, "filledcurves"), 2u);
  const std::string svg = drawn(plot);
  EXPECT_THAT(svg, HasSubstr(">hybrid-50</text>"));
  EXPECT_THAT(svg, Not(HasSubstr("general")));
  EXPECT_EQ(plotSpread(0, groups, std::vector<SpreadBands>(3)).script, "");
}

}  // namespace
}  // namespace hybrid_slam::comparison
