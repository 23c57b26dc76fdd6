#include "slam/loops/PathUncertainty.h"

#include <gtest/gtest.h>

namespace hybrid_slam {
namespace {

using mrpt::math::TPose2D;

/// A path of 100 m along the x axis, each motion of 1 m with variances of 1e-4 m^2 and 1e-6 rad^2.
PathUncertainty straight() {
  std::vector<TPose2D> path;
  for (int i = 0; i <= 100; ++i) path.emplace_back(i, 0, 0);
  return PathUncertainty(path, std::vector<StepVariance>(path.size(), {1e-4, 1e-6}));
}

/// The same, of 50 m out and back.
PathUncertainty outAndBack() {
  std::vector<TPose2D> path;
  for (int i = 0; i <= 100; ++i) path.emplace_back(i <= 50 ? i : 100 - i, 0, 0);
  return PathUncertainty(path, std::vector<StepVariance>(path.size(), {1e-4, 1e-6}));
}

TEST(PathUncertainty, AHeadingErrorMovesAllThatFollows) {
  const Eigen::Matrix3d covariance = straight().between(0, 100);
  EXPECT_NEAR(covariance(0, 0), 100 * 1e-4, 1e-9);
  double across = 100 * 1e-4, common = 0;
  for (int k = 1; k <= 100; ++k) across += 1e-6 * (100 - k) * (100 - k), common += 1e-6 * (100 - k);
  EXPECT_NEAR(covariance(1, 1), across, 1e-9);
  EXPECT_NEAR(covariance(1, 2), common, 1e-9);
  EXPECT_NEAR(covariance(2, 2), 100 * 1e-6, 1e-12);
}

TEST(PathUncertainty, IsTheSameOnAnyPartOfAStraightPath) {
  EXPECT_TRUE(straight().between(10, 40).isApprox(straight().between(60, 90), 1e-9));
}

TEST(PathUncertainty, InTheMapIsThatFromTheNearestPoseSeenThere) {
  const PathUncertainty uncertainty = straight();
  const Eigen::Matrix3d seen = Eigen::Vector3d(0.01, 0.01, 1e-4).asDiagonal();
  const std::vector<KnownPair> known{{KnownPair::kMapFrame, 20, seen}, {KnownPair::kMapFrame, 60, seen}};
  EXPECT_FALSE(uncertainty.inMap(50, {{10, 20, seen}}));
  EXPECT_TRUE(uncertainty.inMap(60, known)->isApprox(seen));
  EXPECT_TRUE(uncertainty.inMap(50, known)->isApprox(seen + uncertainty.between(60, 50)));
  EXPECT_TRUE(uncertainty.between(0, 100, known).isApprox(uncertainty.between(0, 100)));
}

TEST(PathUncertainty, AKnownPairIsAShortCut) {
  const PathUncertainty uncertainty = outAndBack();
  const double direct = uncertainty.between(5, 95).trace();
  EXPECT_LT(uncertainty.between(5, 95, {KnownPair{10, 90}}).trace(), 0.2 * direct);
  EXPECT_DOUBLE_EQ(uncertainty.between(5, 10, {KnownPair{0, 90}}).trace(),
                   uncertainty.between(5, 10).trace());
}

TEST(PathUncertainty, AShortCutIsOneInBothDirections) {
  for (const auto& [from, to] : {std::pair<size_t, size_t>(5, 95), {95, 5}})
    EXPECT_NEAR(outAndBack().between(from, to, {KnownPair{10, 90}})(2, 2), 10 * 1e-6, 1e-12) << from;
}

/// 20 m beyond the pair.
TEST(PathUncertainty, TheHeadingOfAKnownPairMovesWhatFollows) {
  const double variance = 1e-6;
  const Eigen::Matrix3d heading = Eigen::Vector3d(0, 0, variance).asDiagonal();
  const PathUncertainty path = outAndBack();
  const Eigen::Matrix3d more =
      path.between(5, 70, {KnownPair{10, 90, heading, true}}) - path.between(5, 70, {KnownPair{10, 90}});
  EXPECT_NEAR(more(0, 0), 0, 1e-12);
  EXPECT_NEAR(more(1, 1), 400 * variance, 1e-12);
  EXPECT_NEAR(more(1, 2), 20 * variance, 1e-12);
  EXPECT_NEAR(more(2, 2), variance, 1e-12);
  const Eigen::Matrix3d without =
      path.between(5, 70, {KnownPair{10, 90, heading}}) - path.between(5, 70, {KnownPair{10, 90}});
  EXPECT_NEAR(without(1, 1), 0, 1e-12) << "as loop closing takes it";
}

TEST(PathUncertainty, ASlipIsWide) {
  const StepVariance normal = stepVariance({0.3, 0, 0.1}, false), slip = stepVariance({0.3, 0, 0.1}, true);
  EXPECT_GT(slip.position, 10 * normal.position);
  EXPECT_GT(slip.heading, 10 * normal.heading);
}

}  // namespace
}  // namespace hybrid_slam
