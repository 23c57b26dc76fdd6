#include "slam/filter/WeightTerms.h"

#include <gtest/gtest.h>

#include "testing/MappedRoom.h"

namespace hybrid_slam {
namespace {

using namespace test;

/// A particle with a wall in its database, and a scan of this wall with a corner.
struct Scene {
  Scene() {
    for (int i = 0; i < 5; ++i)
      particle.lines.write().update({makeSegment({2, -3}, {2, 3})}, LineDatabaseOptions(),
                                    AssociationOptions());
    scan.lines = {makeSegment({2, -1}, {2, 1})};
  }
  LogDensity density(const FilterConfiguration& c, const TPose2D& pose) const {
    const WeightTerms terms(c);
    return WeightTerms::Density(terms, particle, scan, TPose2D(), Eigen::Matrix3d::Zero())(pose);
  }
  Particle particle;
  PreparedScan scan;
};

const TPose2D kTurned(0.05, 0, 0.002);

TEST(WeightTerms, WithoutLinesAndFeaturesTheyAreOne) {
  FilterConfiguration c;
  c.useLines = c.features.enabled = false;
  const Scene scene;
  EXPECT_EQ(WeightTerms(c).at(scene.particle, kTurned, scene.scan).log(), 0);
  EXPECT_EQ(scene.density(c, kTurned).value, 0);
  EXPECT_TRUE(scene.density(c, kTurned).information.isZero());
}

TEST(WeightTerms, AreThoseOfTheLines) {
  FilterConfiguration c;
  c.features.enabled = false;
  const Scene scene;
  const LineWeight line = lineWeight(scene.scan.lines, kTurned.phi, *scene.particle.lines, c.lineWeight);
  ASSERT_LT(line.value, 0.999);
  EXPECT_EQ(WeightTerms(c).at(scene.particle, kTurned, scene.scan).log(), std::log(line.value));
  const LineLikelihoodOptions options(c.lineWeight, c.association, c.database.minCount, c.improved);
  const LineLikelihood lines(scene.scan.lines, TPose2D(), *scene.particle.lines, options);
  ASSERT_LT(lines(kTurned).value, -0.1);
  EXPECT_EQ(scene.density(c, kTurned).value, lines(kTurned).value);
  EXPECT_EQ(scene.density(c, kTurned).gradient, lines(kTurned).gradient);
}

/// The wall is 2 m from the robot.
TEST(WeightTerms, OnlyLinesWithinTheRadiusGiveADirection) {
  FilterConfiguration c;
  const Scene scene;
  const auto standard = [&] { return WeightTerms(c).at(scene.particle, kTurned, scene.scan).log(); };
  const double whole = standard(), known = scene.density(c, kTurned).value;
  ASSERT_LT(whole, 0);
  c.lineWeight.radius = 2.1;
  EXPECT_EQ(standard(), whole);
  c.lineWeight.radius = 1.9;
  EXPECT_EQ(standard(), 0);
  EXPECT_EQ(scene.density(c, kTurned).value, known) << "a known wall is compared with itself";
  c.database.minCount = 100;
  EXPECT_EQ(scene.density(c, kTurned).value, 0) << "an unknown one has no direction to be compared with";
  c.lineWeight.radius = 2.1;
  EXPECT_LT(scene.density(c, kTurned).value, 0);
}

TEST(WeightTerms, FeaturesThatMatchNothingCostTheSameInBothProposals) {
  FilterConfiguration c;
  c.useLines = false;
  c.features.enabled = true;
  Scene scene;
  PointFeature feature;
  feature.position = {1, 1};
  feature.covariance = 0.01 * Eigen::Matrix2d::Identity();
  for (int i = 0; i < c.features.minCount; ++i) scene.particle.features.write().update({feature}, c.features);
  feature.position = {5, 5};
  scene.scan.features = {feature};
  const double log = WeightTerms(c).at(scene.particle, TPose2D(), scene.scan).log();
  EXPECT_LT(log, -0.1);
  EXPECT_EQ(scene.density(c, TPose2D()).value, log);
}

}  // namespace
}  // namespace hybrid_slam
