#include "run/PathCovariance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

namespace hybrid_slam::run {
namespace {

using mrpt::math::TPose2D;

double deviation(const PoseCovariance& covariance) { return std::sqrt(covariance(0, 0) + covariance(1, 1)); }

/// A path of 20 m along the x axis and back, in steps of 0.5 m.
std::vector<TPose2D> thereAndBack() {
  std::vector<TPose2D> path;
  for (int i = 0; i <= 40; ++i) path.emplace_back(0.5 * i, 0, 0);
  for (int i = 39; i >= 0; --i) path.emplace_back(0.5 * i, 0, M_PI);
  return path;
}

std::vector<Revisit> returnOf(const std::vector<TPose2D>& path, size_t contradicted) {
  Revisit last;
  last.pose = path.back(), last.update = path.size() - 1, last.compared = 50,
  last.contradicted = contradicted;
  return {last};
}

TEST(PathCovariance, OfParticles) {
  const PoseCovariance covariance = covarianceOf({{{1, 2, M_PI - 0.1}, 0}, {{1, 4, 0.1 - M_PI}, 0}});
  EXPECT_NEAR(covariance(0, 0), 0, 1e-12);
  EXPECT_NEAR(covariance(1, 1), 1, 1e-12);
  EXPECT_NEAR(covariance(2, 2), 0.01, 1e-12) << "headings wrap";
  EXPECT_NEAR(covariance(1, 2), 0.1, 1e-12);
  EXPECT_EQ(covarianceOf({}), PoseCovariance::Zero());
  EXPECT_NEAR(covarianceOf({{{0, 0, 0}, 0}, {{1, 0, 0}, -1000}})(0, 0), 0, 1e-12) << "by weight";
}

TEST(PathCovariance, GrowsAlongThePath) {
  const auto path = thereAndBack();
  const auto all = pathCovariances(path, {}, {}, true);
  ASSERT_EQ(all.size(), path.size());
  EXPECT_LT(deviation(all[0]), 0.02);
  EXPECT_GT(deviation(all[40]), deviation(all[20]));
  EXPECT_GT(deviation(all[80]), deviation(all[40]));
  EXPECT_GT(deviation(pathCovariances(path, {}, {}, false)[40]), deviation(all[40])) << "without lines";
}

TEST(PathCovariance, ShrinksWhereTheMapIsSeenAgain) {
  const auto path = thereAndBack();
  const auto open = pathCovariances(path, {}, {}, true);
  const auto closed = pathCovariances(path, {}, returnOf(path, 2), true);
  EXPECT_LT(deviation(closed[80]), 0.3 * deviation(open[80]));
  EXPECT_LT(deviation(closed[70]), deviation(open[70]));
  EXPECT_EQ(closed[20], open[20]) << "the way from the start is shorter";
  EXPECT_EQ(pathCovariances(path, {}, returnOf(path, 40), true)[80], open[80]) << "contradicted";
}

TEST(PathCovariance, HoldsTheSpreadOfTheParticles) {
  const auto path = thereAndBack();
  std::vector<PoseCovariance> particles(path.size(), PoseCovariance::Zero());
  particles[10] = PoseCovariance::Identity();
  const auto all = pathCovariances(path, particles, {}, true), none = pathCovariances(path, {}, {}, true);
  EXPECT_NEAR((all[10] - none[10] - PoseCovariance::Identity()).norm(), 0, 1e-12);
  EXPECT_EQ(all[11], none[11]);
}

TEST(PathCovariance, ARowForEachPose) {
  std::ostringstream out;
  const PoseCovariance covariance = Eigen::Vector3d(1, 2, 3).asDiagonal();
  writeCovariances(out, {{10, {0, 0, 0}}, {10.5, {0.25, 0, 0}}}, {1, 1}, {{0, 0, 0}}, {covariance});
  EXPECT_EQ(out.str(),
            "timestamp,xx,xy,yy,xphi,yphi,phiphi\n"
            "10.000000,1,0,2,0,0,3\n"
            "10.500000,1.0001,0,2.0001,0,0,3.00008\n");
}

}  // namespace
}  // namespace hybrid_slam::run
