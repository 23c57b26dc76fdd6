#include "slam/loops/PathUncertainty.h"

#include <gtest/gtest.h>

#include <random>

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

TEST(PathUncertainty, HalfOfAKnownLoopHasHalfOfTheVariance) {
  std::vector<TPose2D> path;
  for (int i = 0; i <= 100; ++i) path.emplace_back(std::min(i, 100 - i), 0, 0);
  const PathUncertainty loop(path, std::vector<StepVariance>(path.size(), {1e-4, 0}));
  const std::vector<KnownPair> known{{0, 100, 1e-8 * Eigen::Matrix3d::Identity()}};
  EXPECT_NEAR(loop.between(0, 50)(0, 0), 50e-4, 1e-9);
  EXPECT_NEAR(loop.relaxed(0, 50, known)(0, 0), 25e-4, 1e-7);
  EXPECT_NEAR(loop.relaxed(50, 0, known)(1, 1), 25e-4, 1e-7);
  EXPECT_NEAR(loop.relaxed(0, 25, known)(0, 0), 25e-4 * 0.75, 1e-7);
  EXPECT_NEAR(loop.relaxed(25, 75, known)(0, 0), 25e-4, 1e-7);
}

/// The error of a place moved by `lever` from a pose, by the error of the pose.
Eigen::Matrix3d effectOf(const Eigen::Vector2d& lever) {
  Eigen::Matrix3d effect = Eigen::Matrix3d::Identity();
  effect(0, 2) = -lever.y(), effect(1, 2) = lever.x();
  return effect;
}

/// A random path, with the errors of its poses as the solution of the linear least squares problem.
class PathUncertaintyOfALoop : public testing::TestWithParam<unsigned> {
 protected:
  PathUncertaintyOfALoop() {
    std::mt19937 random(GetParam());
    std::uniform_real_distribution<> uniform(-1, 1);
    TPose2D pose;
    for (int i = 0; i < kPoses; ++i) {
      path_.push_back(pose);
      steps_.push_back({1e-4 * (1.5 + uniform(random)), 1e-6 * (1.5 + uniform(random))});
      pose = pose + TPose2D(1 + 0.3 * uniform(random), 0, 0.4 * uniform(random));
    }
    for (size_t i = 1; i < kPoses; ++i) {
      const StepVariance& step = steps_[i];
      add(i - 1, i, Eigen::Vector3d(step.position, step.position, step.heading).asDiagonal());
    }
  }
  /// The error of pose b: that of pose a moved there, and an error of this covariance.
  void add(size_t a, size_t b, const Eigen::Matrix3d& covariance) {
    Eigen::Matrix<double, 3, 3 * kPoses> jacobian = Eigen::Matrix<double, 3, 3 * kPoses>::Zero();
    const Eigen::Vector2d lever(path_[b].x - path_[a].x, path_[b].y - path_[a].y);
    jacobian.block<3, 3>(0, 3 * a) = -effectOf(lever);
    jacobian.block<3, 3>(0, 3 * b).setIdentity();
    information_ += jacobian.transpose() * covariance.inverse() * jacobian;
  }
  /// With respect to pose `from`, whose error is zero.
  Eigen::Matrix3d exact(size_t from, size_t to) const {
    Eigen::MatrixXd fixed = information_;
    fixed.block<3, 3>(3 * from, 3 * from) += 1e14 * Eigen::Matrix3d::Identity();
    return fixed.inverse().block<3, 3>(3 * to, 3 * to);
  }

  static constexpr int kPoses = 30;
  std::vector<TPose2D> path_;
  std::vector<StepVariance> steps_;
  Eigen::MatrixXd information_ = Eigen::MatrixXd::Zero(3 * kPoses, 3 * kPoses);
};

TEST_P(PathUncertaintyOfALoop, OneKnownPairIsTakenExactly) {
  const KnownPair pair{5, 24, Eigen::Vector3d(2e-4, 1e-4, 3e-6).asDiagonal()};
  add(pair.earlier, pair.later, pair.covariance);
  const PathUncertainty uncertainty(path_, steps_);
  for (const auto& [from, to] : {std::pair<size_t, size_t>(0, 3),
                                 {0, 10},
                                 {0, 28},
                                 {7, 20},
                                 {20, 7},
                                 {26, 2},
                                 {5, 24},
                                 {24, 5},
                                 {12, 27},
                                 {25, 29}}) {
    const Eigen::Matrix3d expected = exact(from, to), here = uncertainty.relaxed(from, to, {pair});
    EXPECT_LT((here - expected).norm(), 1e-3 * expected.norm()) << from << " to " << to;
  }
}

TEST_P(PathUncertaintyOfALoop, OfSeveralPairsTheBestCounts) {
  const Eigen::Matrix3d covariance = Eigen::Vector3d(2e-4, 1e-4, 3e-6).asDiagonal();
  const KnownPair wide{2, 27, covariance}, tight{8, 20, covariance};
  const PathUncertainty uncertainty(path_, steps_);
  for (const size_t to : {4, 12, 18, 25}) {
    const double one = uncertainty.relaxed(0, to, {wide}).topLeftCorner<2, 2>().trace(),
                 other = uncertainty.relaxed(0, to, {tight}).topLeftCorner<2, 2>().trace();
    EXPECT_DOUBLE_EQ((uncertainty.relaxed(0, to, {wide, tight}).topLeftCorner<2, 2>().trace()),
                     std::min(one, other));
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, PathUncertaintyOfALoop, testing::Range(1u, 6u));

TEST(PathUncertainty, ASlipIsWide) {
  const StepVariance normal = stepVariance({0.3, 0, 0.1}, false), slip = stepVariance({0.3, 0, 0.1}, true);
  EXPECT_GT(slip.position, 10 * normal.position);
  EXPECT_GT(slip.heading, 10 * normal.heading);
}

}  // namespace
}  // namespace hybrid_slam
