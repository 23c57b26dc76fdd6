#include "slam/filter/ParticleNumber.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/RandomStream.h"

namespace hybrid_slam {
namespace {

std::vector<WeightedPose> cloud(size_t particles, double sigma) {
  RandomStream random(1, 0, 0);
  std::vector<WeightedPose> poses;
  for (size_t i = 0; i < particles; ++i)
    poses.push_back({{10.03 + sigma * random.gaussian(), -5.02, M_PI}, 0});
  return poses;
}

/// Half the quantile of chi-square with k - 1 degrees of freedom over the error: Fox 2003, eq. (6), of
/// which eq. (7) is an approximation. 95 %: 3.841, 9.488, 30.144 for 1, 4, 19.
TEST(ParticleNumber, IsTheQuantileOfChiSquare) {
  const double twice = 2 * kDivergence;
  EXPECT_NEAR(kldParticles(2), 3.841 / twice, 0.04 * 3.841 / twice);
  EXPECT_NEAR(kldParticles(5), 9.488 / twice, 0.01 * 9.488 / twice);
  EXPECT_NEAR(kldParticles(20), 30.144 / twice, 0.01 * 30.144 / twice);
  EXPECT_EQ(kldParticles(1), 1);
}

TEST(ParticleNumber, GrowsWithTheSpread) {
  double before = 0;
  for (const double sigma : {0.1, 0.3, 1.0, 3.0}) {
    const double bins = occupiedBins(cloud(1000, sigma * kBinSize));
    EXPECT_GT(bins, before);
    before = bins;
  }
}

/// A narrow cloud is one bin, on both sides of -pi as well.
TEST(ParticleNumber, ANarrowCloudIsOneBin) {
  auto poses = cloud(50, 0.1 * kBinSize);
  poses.push_back({{poses[0].pose.x, poses[0].pose.y, -M_PI}, 0});
  EXPECT_NEAR(occupiedBins(poses), 1, 1e-9);
}

TEST(ParticleNumber, WeighsTheBins) {
  const auto bins = [](double weight) {
    return occupiedBins({{{0, 0, 0}, std::log(weight)}, {{5, 0, 0}, std::log(1 - weight)}});
  };
  EXPECT_NEAR(bins(0.5), 2, 1e-9);
  EXPECT_NEAR(bins(0.1), std::exp(-0.1 * std::log(0.1) - 0.9 * std::log(0.9)), 1e-9);
  EXPECT_LT(bins(1e-9), 1.001);
}

}  // namespace
}  // namespace hybrid_slam
