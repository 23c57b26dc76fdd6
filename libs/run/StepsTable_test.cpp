#include "run/StepsTable.h"

#include <gtest/gtest.h>

#include <sstream>

namespace hybrid_slam::run {
namespace {

TEST(StepsTable, HeaderIsTheDocumentedOne) {
  std::ostringstream out;
  writeStepsHeader(out);
  EXPECT_EQ(
      out.str(),
      "timestamp,particles,ess,resampled,std_x,std_y,std_phi,std_along,std_across,w_grid_best,w_line_best,"
      "lines_seen,lines_matched,step_ms,matched,slipped,loops_closed,loop_shift,degeneracy,frames_deg\n");
}

TEST(StepsTable, ARow) {
  FilterStep step;
  step.particles = 50;
  step.ess = 0.25;
  step.resampled = true;
  step.stdX = 0.1, step.stdY = 0.2, step.stdPhi = 0.3, step.stdAlong = 0.4, step.stdAcross = 0.5;
  step.gridWeight = 0.6, step.lineWeight = 0.7;
  step.linesSeen = 4, step.linesMatched = 3;
  step.matched = 0.875, step.slipped = true;
  step.loop.emplace().shift = 4.25;
  step.degeneracy = 0.0625;
  step.frames = {{mrpt::DEG2RAD(30.0), 6, 3}, {mrpt::DEG2RAD(-5.5), 5, 2}};
  std::ostringstream out;
  writeStep(out, 1137834225.713386, step, 12.3456);
  EXPECT_EQ(
      out.str(),
      "1137834225.713386,50,0.250000,1,0.100000,0.200000,0.300000,0.400000,0.500000,0.600000,0.700000,4,3,"
      "12.346,0.875,1,1,4.250000,0.0625,30.00 -5.50\n");
}

TEST(StepsTable, MissingValuesAreEmpty) {
  std::ostringstream out;
  writeStep(out, 1, FilterStep(), 2);
  EXPECT_EQ(out.str(),
            "1.000000,0,1.000000,,0.000000,0.000000,0.000000,0.000000,0.000000,,,0,0,2.000,,,0,0.000000,,\n");
}

LoopClosure loopAt(size_t later, double shift) {
  LoopClosure loop;
  loop.later = later, loop.shift = shift;
  return loop;
}

TEST(StepsTable, ALoopOfTheRefinementIsInTheRowOfItsLaterVisit) {
  std::ostringstream out;
  writeStepsHeader(out);
  FilterStep step;
  writeStep(out, 1, step, 2);
  step.loop = loopAt(0, 4.25);
  writeStep(out, 2, step, 2);
  step.loop.reset();
  step.degeneracy = 0.0625;
  step.frames = {{mrpt::DEG2RAD(30.0), 6, 3}};
  writeStep(out, 3, step, 2);
  const std::string before = out.str();
  EXPECT_EQ(withLoops(before, {}), before);

  const std::string after = withLoops(before, {loopAt(2, 0.5), loopAt(1, 1.5)});
  const std::string values = ",0,1.000000,,0.000000,0.000000,0.000000,0.000000,0.000000,,,0,0,2.000,,,";
  std::string expected = before.substr(0, before.find('\n') + 1);
  expected += "1.000000" + values + "0,0.000000,,\n";
  expected += "2.000000" + values + "2,4.250000,,\n";  // the larger shift
  expected += "3.000000" + values + "1,0.500000,0.0625,30.00\n";
  EXPECT_EQ(after, expected);
}

TEST(StepsTable, RowsOfADamagedSessionDoNoHarm) {
  for (const std::string row : {"", "x", ",", "1,2", ",,", "1,2,3", ",,,"})
    EXPECT_NO_THROW(withLoops("a\n" + row + "\n", {loopAt(0, 0.5)})) << row;
  EXPECT_EQ(withLoops("a\n1,x,y,,\n", {loopAt(0, 0.5)}), "a\n1,1,0.500000,,\n");
}

TEST(ParticlesTable, ARowForEachParticle) {
  FilterStep step;
  step.poses = {{{1, 2, 3}, -0.5}, {{-1.25, 0, 0.125}, 0}};
  std::ostringstream out;
  writeParticlesHeader(out);
  writeParticles(out, 1137834225.713386, step);
  writeParticles(out, 2, FilterStep());
  EXPECT_EQ(out.str(),
            "timestamp,x,y,phi,log_weight\n"
            "1137834225.713386,1.000000,2.000000,3.000000,-0.5\n"
            "1137834225.713386,-1.250000,0.000000,0.125000,0\n");
}

}  // namespace
}  // namespace hybrid_slam::run
