#include "study/comparison/ParticlePlot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "files/TemporaryFolder.h"
#include "testing/CommaLocale.h"

namespace hybrid_slam::comparison {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

ParticleSnapshot at(double timestamp, double phi) { return {timestamp, {{{0, 0, phi}, 0}}}; }

TEST(Particles, AreReadUpdateByUpdate) {
  const files::TemporaryFolder folder;
  const auto run = loadParticles(folder.write("particles.csv",
                                              "timestamp,x,y,phi,log_weight\n"
                                              "10.5,1,2,0.5,-3\n10.5,4,5,0.25,-1\n11.5,7,8,0,0\n"));
  ASSERT_EQ(run.size(), 2u);
  EXPECT_EQ(run[0].timestamp, 10.5);
  ASSERT_EQ(run[0].particles.size(), 2u);
  EXPECT_EQ(run[0].best().x, 4);
  EXPECT_EQ(run[0].best().phi, 0.25);
  EXPECT_DOUBLE_EQ(run[0].radius(), std::hypot(3, 3));
  EXPECT_EQ(run[1].particles[0].pose.y, 8);
  EXPECT_TRUE(loadParticles(folder.path("none.csv")).empty());
  EXPECT_THROW(loadParticles(folder.write("broken.csv", "timestamp,x,y,phi,log_weight\n1,2,x,0,0\n")),
               std::runtime_error);
}

TEST(Particles, AreReadTheSameInEveryLocale) {
  const test::CommaLocale german;
  const files::TemporaryFolder folder;
  const auto run =
      loadParticles(folder.write("particles.csv", "timestamp,x,y,phi,log_weight\n10.5,1.25,2,0.5,-3\n"));
  ASSERT_EQ(run.size(), 1u);
  EXPECT_EQ(run[0].best().x, 1.25);
}

TEST(Particles, SnapshotsAreAtTheLargestTurns) {
  // Turns of 1 rad at 3 s and, through the half turn, at 6 s; small ones elsewhere.
  const std::vector<ParticleSnapshot> run{at(0, 0),       at(1, 0.1), at(2, 0.1),  at(3, 1.1),
                                          at(4, 2.7 - 2), at(5, 3.0), at(6, -2.0), at(7, -1.9)};
  EXPECT_THAT(turningMoments(run, 2), ElementsAre(3, 5));
  EXPECT_THAT(turningMoments(run, 1), ElementsAre(5));
  EXPECT_TRUE(turningMoments({}, 4).empty());
  EXPECT_TRUE(turningMoments({at(0, 0)}, 4).empty());
  EXPECT_EQ(nearestSnapshot(run, 4.4).timestamp, 4);
  EXPECT_EQ(nearestSnapshot(run, 99).timestamp, 7);
}

TEST(Particles, ArePlottedAroundTheRobot) {
  ParticleSnapshot snapshot{5, {{{1, 1, 0}, 0}, {{1.1, 1, 0.1}, -1}, {{30, 1, 0}, -9}}};
  const simulation::BuildingPlan plan(
      {simulation::Wall::straight({0, 1.5}, {4, 1.5}), simulation::Wall::straight({50, 0}, {50, 9})});
  const Plot plot = plotParticles(snapshot, {0, 0, 0}, &plan, 2, "hybrid-20, 5 s");
  EXPECT_EQ(plot.description, "particles of hybrid-20, 5 s");
  EXPECT_THAT(plot.script, HasSubstr("set xrange [0:2]\nset yrange [0:2]\n"));  // the robot in the middle
  EXPECT_THAT(plot.script, HasSubstr("set tics 0.5\n"));
  EXPECT_THAT(plot.script, HasSubstr("$robot << EOD\n1 1\nEOD\n"));
  EXPECT_THAT(plot.script, HasSubstr("$particles << EOD\n1 1 0.1 0\n1.1 1 "));
  EXPECT_THAT(plot.script, Not(HasSubstr("30 1 ")));  // out of sight
  Gnuplot gnuplot;
  EXPECT_THAT(gnuplot.draw({plot}), HasSubstr(">hybrid-20, 5 s</text>"));
  EXPECT_THAT(plotParticles(snapshot, {-9, 4, 1}, nullptr, 2, "").script, Not(HasSubstr("$walls")));
}

TEST(Particles, LargeSetsAreThinned) {
  ParticleSnapshot snapshot{5, {}};
  for (int i = 0; i < 1001; ++i) snapshot.particles.push_back({{0.001 * i, 0, 0}, 0});
  const std::string script = plotParticles(snapshot, {0, 0, 0}, nullptr, 4, "").script;
  const auto rows = std::count(script.begin() + script.find("$particles"), script.end(), '\n');
  EXPECT_GT(rows, 150);
  EXPECT_LE(rows, 203);
}

}  // namespace
}  // namespace hybrid_slam::comparison
