#include "slam/filter/FeatureLikelihood.h"

#include <gtest/gtest.h>

#include "slam/features/FeatureDetection.h"
#include "testing/TestScans.h"

namespace hybrid_slam {
namespace {

using namespace test;

const TPose2D kPose(1, 2, 0.7);
constexpr double kSigma = 0.1;
const Eigen::Matrix3d kCertain = Eigen::Matrix3d::Zero();

PointFeature cornerAt(const TPoint2D& at) {
  PointFeature feature;
  feature.position = at;
  feature.covariance = kSigma * kSigma * Eigen::Matrix2d::Identity();
  return feature;
}

/// A database of corners at these places, seen often enough from kPose.
FeatureDatabase databaseOf(const std::vector<TPoint2D>& places, int count = 100) {
  FeatureDatabase database;
  std::vector<PointFeature> seen;
  for (const TPoint2D& at : places) seen.push_back(transformed(cornerAt(at), kPose));
  for (int i = 0; i < count; ++i) database.update(seen, FeatureOptions());
  return database;
}

double variance(int count) { return kSigma * kSigma * (1 + 1.0 / count); }

TEST(FeatureLikelihood, IsTheGaussianOfTheInnovation) {
  const FeatureOptions options;
  const FeatureLikelihood likelihood({cornerAt({3, 1})}, kPose, kCertain, databaseOf({{3, 1}}), options);
  EXPECT_NEAR(likelihood(kPose).value, 0, 1e-12);
  for (const TPoint2D off : {TPoint2D(0.1, 0), TPoint2D(0, -0.15)})
    EXPECT_NEAR(likelihood(TPose2D(kPose.x + off.x, kPose.y + off.y, kPose.phi)).value,
                -0.5 * off.sqrNorm() / variance(100), 1e-9);
  EXPECT_NEAR(likelihood(TPose2D(5, 5, 0)).value, std::log(options.floor), 1e-12) << "never below the floor";
}

TEST(FeatureLikelihood, InformsOfThePositionInAllDirectionsAndTheHeading) {
  const Eigen::Matrix3d information =
      FeatureLikelihood({cornerAt({3, 0})}, kPose, kCertain, databaseOf({{3, 0}}), FeatureOptions())(kPose)
          .information;
  const double one = 1 / variance(100);
  EXPECT_NEAR(information(0, 0), one, 1e-6);
  EXPECT_NEAR(information(1, 1), one, 1e-6);
  EXPECT_NEAR(information(2, 2), 9 * one, 1e-6);
  EXPECT_NEAR(information(0, 2), -3 * std::sin(kPose.phi) * one, 1e-6);
}

TEST(FeatureLikelihood, FourFeaturesWeighAsMuchAsTwoIndependentOnes) {
  const std::vector<TPoint2D> places{{3, 1}, {2, -1}, {6, 4}, {1, -5}};
  std::vector<PointFeature> seen;
  for (const TPoint2D& at : places) seen.push_back(cornerAt(at));
  const TPose2D off(kPose.x + 0.1, kPose.y, kPose.phi);
  const double one =
      FeatureLikelihood({seen[0]}, off, kCertain, databaseOf({places[0]}), FeatureOptions())(off).value;
  const double four = FeatureLikelihood(seen, off, kCertain, databaseOf(places), FeatureOptions())(off).value;
  EXPECT_LT(one, -0.1);
  EXPECT_NEAR(four, 2 * one, 1e-9);
}

TEST(FeatureLikelihood, WithoutKnownFeaturesItIsNeutral) {
  const FeatureOptions options;
  const auto expectNeutral = [&](const std::vector<PointFeature>& seen, const FeatureDatabase& database) {
    const LogDensity density = FeatureLikelihood(seen, kPose, kCertain, database, options)(kPose);
    EXPECT_EQ(density.value, 0);
    EXPECT_EQ(density.gradient, Eigen::Vector3d::Zero());
    EXPECT_EQ(density.information, Eigen::Matrix3d::Zero());
  };
  expectNeutral({}, FeatureDatabase());
  expectNeutral({}, databaseOf({{3, 1}}));
  expectNeutral({cornerAt({3, 1})}, FeatureDatabase());
  expectNeutral({cornerAt({3, 1})}, databaseOf({{3, 1}}, options.minCount - 1));
}

TEST(FeatureLikelihood, NoPoseGainsByLosingAMatch) {
  const FeatureOptions options;
  const FeatureDatabase database = databaseOf({{3, 1}, {2, -1}});
  const std::vector<PointFeature> seen{cornerAt({3, 1}), cornerAt({2, -1}), cornerAt({5, 0})};
  double last = 0;
  for (double off = 0; off < 1; off += 0.02) {  // associated at each pose, as in the standard proposal
    const TPose2D pose(kPose.x + off, kPose.y, kPose.phi);
    const double value = FeatureLikelihood(seen, pose, kCertain, database, options)(pose).value;
    EXPECT_LE(value, last + 1e-12) << off;
    EXPECT_GE(value, std::sqrt(3) * std::log(options.floor) - 1e-12);
    last = value;
  }
  EXPECT_NEAR(last, std::sqrt(3) * std::log(options.floor), 1e-9);
}

TEST(FeatureLikelihood, AnUncertainPoseWidensTheGateButNotTheGaussian) {
  const FeatureOptions options;
  const FeatureDatabase database = databaseOf({{3, 1}});
  const TPose2D predicted(kPose.x + 0.5, kPose.y, kPose.phi);
  const std::vector<PointFeature> seen{cornerAt({3, 1})};
  const Eigen::Matrix3d uncertainty = 0.2 * 0.2 * Eigen::Matrix3d::Identity();
  EXPECT_LT(FeatureLikelihood(seen, predicted, kCertain, database, options)(kPose).value, -1);
  const FeatureLikelihood likelihood(seen, predicted, uncertainty, database, options);
  EXPECT_NEAR(likelihood(kPose).value, 0, 1e-12);
  EXPECT_NEAR(likelihood(kPose).information(0, 0), 1 / variance(100), 1e-6);
}

TEST(FeatureLikelihood, TheGradientMatchesTheValue) {
  const std::vector<TPoint2D> places{{3, 1}, {2, -1}, {6, 4}};
  std::vector<PointFeature> seen;
  for (const TPoint2D& at : places) seen.push_back(withModelError(cornerAt(at), 0.05));
  const FeatureLikelihood likelihood(seen, kPose, kCertain, databaseOf(places), FeatureOptions());
  RandomStream random(7, 0, 0);
  int sloped = 0;
  for (int i = 0; i < 200; ++i) {
    const TPose2D pose(kPose.x + 0.05 * random.gaussian(), kPose.y + 0.05 * random.gaussian(),
                       kPose.phi + 0.02 * random.gaussian());
    constexpr double kStep = 1e-6;
    const auto slope = [&](double x, double y, double phi) {
      const TPose2D more(pose.x + kStep * x, pose.y + kStep * y, pose.phi + kStep * phi),
          less(pose.x - kStep * x, pose.y - kStep * y, pose.phi - kStep * phi);
      return (likelihood(more).value - likelihood(less).value) / (2 * kStep);
    };
    const Eigen::Vector3d differences(slope(1, 0, 0), slope(0, 1, 0), slope(0, 0, 1));
    const LogDensity density = likelihood(pose);
    EXPECT_LT((density.gradient - differences).norm(), 1e-4 * (1 + density.gradient.norm()));
    sloped += density.gradient.norm() > 0;
  }
  EXPECT_GT(sloped, 150);
}

}  // namespace
}  // namespace hybrid_slam
