#include "slam/features/FeatureDatabase.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "base/State.h"
#include "testing/TestScans.h"

namespace hybrid_slam {
namespace {

using namespace test;

PointFeature corner(double x, double y, double sigma = 0.05, double direction = 0) {
  PointFeature feature;
  feature.kind = FeatureKind::convexCorner;
  feature.position = {x, y};
  feature.covariance = sigma * sigma * Eigen::Matrix2d::Identity();
  feature.direction = direction;
  return feature;
}

PointFeature pillar(double x, double y, double radius) {
  PointFeature feature = corner(x, y);
  feature.kind = FeatureKind::pillar;
  feature.radius = radius;
  feature.radiusVariance = 0.01 * 0.01;
  return feature;
}

TEST(FeatureMatch, IsTheSquaredMahalanobisDistance) {
  EXPECT_NEAR(*squaredMatchDistance(corner(1, 2, 0.03), corner(1.05, 2, 0.04)), 1, 1e-9);
  EXPECT_FALSE(
      squaredMatchDistance(corner(1, 2, 0.03), corner(1.16, 2, 0.04)));  // over three standard deviations
  PointFeature far = corner(9, 2, 0.03), unknown = corner(1, 2, 100);
  EXPECT_FALSE(squaredMatchDistance(far, unknown)) << "8 m apart";
}

TEST(FeatureMatch, IsOfTheSameShape) {
  EXPECT_TRUE(squaredMatchDistance(corner(0, 0, 0.05, 3.1), corner(0, 0, 0.05, -3.1)));
  EXPECT_FALSE(squaredMatchDistance(corner(0, 0, 0.05, 0), corner(0, 0, 0.05, M_PI / 2)));
  PointFeature concave = corner(0, 0);
  concave.kind = FeatureKind::concaveCorner;
  EXPECT_FALSE(squaredMatchDistance(corner(0, 0), concave));
  EXPECT_TRUE(squaredMatchDistance(pillar(0, 0, 0.3), pillar(0, 0, 0.33)));
  EXPECT_FALSE(squaredMatchDistance(pillar(0, 0, 0.3), pillar(0, 0, 0.5)));
  EXPECT_FALSE(squaredMatchDistance(pillar(0, 0, 0.3), corner(0, 0)));
}

TEST(FeatureMatch, WhatIsNotANumberMatchesNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(squaredMatchDistance(corner(nan, 0), corner(0, 0)));
  EXPECT_FALSE(squaredMatchDistance(corner(0, 0, nan), corner(0, 0)));
}

TEST(FeatureMerge, IsTheMeanOfEqualObservations) {
  MapFeature known{pillar(1, 2, 0.3)};
  RandomStream random(1, 0, 0);
  TPoint2D sum(1, 2);
  double radii = 0.3;
  for (int i = 2; i <= 50; ++i) {
    const PointFeature seen =
        pillar(1 + 0.05 * random.gaussian(), 2 + 0.05 * random.gaussian(), 0.3 + 0.01 * random.gaussian());
    sum += seen.position;
    radii += seen.radius;
    known = merged(known, seen);
    EXPECT_EQ(known.count, i);
    EXPECT_LT((known.position - sum * (1.0 / i)).norm(), 1e-9);
    EXPECT_NEAR(known.radius, radii / i, 1e-9);
    EXPECT_NEAR(known.covariance(0, 0), 0.0025 / i, 1e-12);
  }
}

TEST(FeatureMerge, OfDifferentCovariancesMovesAlongTheUncertainAxis) {
  MapFeature known{corner(0, 0)};
  known.covariance << 1, 0, 0, 1e-6;
  const MapFeature result = merged(known, corner(0.1, 0.1, 0.01));
  EXPECT_NEAR(result.position.x, 0.1, 1e-4);
  EXPECT_NEAR(result.position.y, 0.001, 1e-4);
  EXPECT_GT(result.covariance.determinant(), 0);
}

TEST(FeatureDatabase, InsertsMergesAndPrunes) {
  FeatureOptions options;
  FeatureDatabase database;
  for (int i = 0; i < options.minCount; ++i) database.update({corner(0, 0), pillar(3, 0, 0.2)}, options);
  database.update({corner(5, 5)}, options);
  ASSERT_EQ(database.features().size(), 3u);
  EXPECT_EQ(database.features()[0].count, options.minCount);
  const auto all = database.candidates({corner(0, 0), corner(5, 5)});
  EXPECT_EQ(all.size(), 3u);
  EXPECT_EQ(database.closestMatch(corner(5.01, 5), all), &database.features()[2]);
  EXPECT_EQ(database.closestMatch(corner(5.01, 5), all, options.minCount), nullptr) << "seen once";
  EXPECT_EQ(database.closestMatch(corner(0.02, 0), all, options.minCount), &database.features()[0]);
  for (int i = 0; i < 2 * options.pruneInterval; ++i) database.update({}, options);
  EXPECT_EQ(database.features().size(), 2u) << "what was seen once is gone";
}

TEST(FeatureDatabase, TheCandidatesHoldEveryMatch) {
  FeatureOptions options;
  options.pruneInterval = 1000;  // none is pruned
  FeatureDatabase database;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(0, 20), deviation(0.01, 1);
  for (int i = 0; i < 300; ++i) database.update({corner(place(random), place(random), 0.001)}, options);
  size_t matched = 0;
  for (int i = 0; i < 200; ++i) {
    const std::vector<PointFeature> seen{corner(place(random), place(random), deviation(random)),
                                         corner(place(random), place(random), deviation(random))};
    const auto candidates = database.candidates(seen);
    for (const PointFeature& feature : seen) {
      const MapFeature* closest = nullptr;
      double least = std::numeric_limits<double>::infinity();
      for (const MapFeature& known : database.features())
        if (const auto squares = squaredMatchDistance(feature, known); squares && *squares < least)
          least = *squares, closest = &known;
      ASSERT_EQ(database.closestMatch(feature, candidates), closest);
      matched += closest != nullptr;
    }
  }
  EXPECT_GT(matched, 200u);
  EXPECT_TRUE(database.candidates({corner(30, 5)}).empty());
}

TEST(FeatureDatabase, ANewFeatureSurvivesThePruning) {
  FeatureOptions options;
  FeatureDatabase database;
  for (int i = 1; i < options.pruneInterval; ++i) database.update({}, options);
  database.update({corner(0, 0)}, options);
  EXPECT_EQ(database.features().size(), 1u);
}

TEST(FeatureDatabase, OneFeatureSeenManyTimesStaysOne) {
  RandomStream random(3, 0, 0);
  FeatureDatabase database;
  for (int i = 0; i < 1000; ++i)
    database.update({corner(0.02 * random.gaussian(), 0.02 * random.gaussian())}, FeatureOptions());
  ASSERT_EQ(database.features().size(), 1u);
  EXPECT_LT(database.features()[0].position.norm(), 0.005);
}

TEST(FeatureDatabase, IsReadAsItWasWritten) {
  FeatureDatabase database, other;
  database.update({corner(1, 2, 0.03, 0.4), pillar(3, 4, 0.2)}, FeatureOptions());
  std::string bytes, again;
  StateWriter out(bytes), outAgain(again);
  out(database);
  StateReader in(bytes);
  in(other);
  outAgain(other);
  EXPECT_EQ(bytes, again);
  EXPECT_EQ(other.features().size(), 2u);
  bytes.resize(bytes.size() - 1);
  StateReader cut(bytes);
  EXPECT_THROW(cut(other), StateError);
}

TEST(FeatureDatabase, AnImpossibleCovarianceIsNotRead) {
  PointFeature flat = corner(1, 2);
  flat.covariance.setZero();
  std::string bytes;
  StateWriter out(bytes);
  out(flat);
  StateReader in(bytes);
  EXPECT_THROW(in(flat), StateError);
}

}  // namespace
}  // namespace hybrid_slam
