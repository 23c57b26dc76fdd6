#include "study/comparison/ParticlePlot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "files/TemporaryFolder.h"
#include "study/comparison/Svg.h"
#include "study/comparison/XmlCheck.h"
#include "testing/CommaLocale.h"

namespace hybrid_slam::comparison {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

size_t count(const std::string& text, const std::string& part) {
  size_t n = 0;
  for (size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++n;
  return n;
}

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

TEST(Particles, AreReadAndPlottedTheSameInEveryLocale) {
  const test::CommaLocale german;
  const files::TemporaryFolder folder;
  const auto run =
      loadParticles(folder.write("particles.csv", "timestamp,x,y,phi,log_weight\n10.5,1.25,2,0.5,-3\n"));
  ASSERT_EQ(run.size(), 1u);
  EXPECT_EQ(run[0].best().x, 1.25);
  EXPECT_EQ(shortNumber(1.25), "1.25");
}

TEST(Particles, TheMomentsAreThoseOfTheLargestTurns) {
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
  const simulation::FloorPlan plan(
      {simulation::Wall::straight({0, 1.5}, {4, 1.5}), simulation::Wall::straight({50, 0}, {50, 9})});
  const std::string svg = plotParticles(snapshot, {0, 0, 0}, &plan, 1.5, "hybrid-20, 5 s");
  EXPECT_EQ(xmlDefect(svg), "");
  EXPECT_EQ(count(svg, "<circle"), 1u + 2u);             // the robot; the third particle is out of sight
  EXPECT_EQ(count(svg, "<polyline"), 1u);                // of the wall that is in sight
  EXPECT_THAT(svg, HasSubstr("cx=\"125\" cy=\"149\""));  // the robot in the middle
  EXPECT_THAT(svg, HasSubstr("hybrid-20, 5 s"));
  EXPECT_EQ(count(plotParticles(snapshot, {-9, 4, 1}, nullptr, 1.5, ""), "<polyline"), 0u);
}

}  // namespace
}  // namespace hybrid_slam::comparison
