#include "run/PathCovariance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "base/Degree.h"

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

std::vector<PoseCovariance> ofPoses(const std::vector<TPose2D>& path,
                                    const std::vector<PoseCovariance>& particles,
                                    const std::vector<Revisit>& returning, bool hasLines,
                                    bool isRelaxed = true) {
  return PathCovariances(path, particles, returning, hasLines, isRelaxed).ofPoses();
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
  const auto all = ofPoses(path, {}, {}, true);
  ASSERT_EQ(all.size(), path.size());
  EXPECT_LT(deviation(all[0]), 0.02);
  EXPECT_GT(deviation(all[40]), deviation(all[20]));
  EXPECT_GT(all[80](2, 2), all[40](2, 2));
  EXPECT_GT(deviation(ofPoses(path, {}, {}, false)[40]), deviation(all[40])) << "without lines";
}

TEST(PathCovariance, TheHeadingErrorOfTheFirstPoseTurnsTheMap) {
  const auto all = ofPoses(thereAndBack(), {}, {}, true);
  const double turn = 0.09 * kDegree;
  EXPECT_NEAR(all[0](1, 1), 1e-4, 1e-12);
  EXPECT_GT(all[40](1, 1), 2e-4 + std::pow(20 * turn, 2));
  EXPECT_LT(all[40](0, 0), 6e-4) << "not along the way";
}

TEST(PathCovariance, ShrinksWhereTheMapIsSeenAgain) {
  const auto path = thereAndBack();
  const auto open = ofPoses(path, {}, {}, false);
  const auto closed = ofPoses(path, {}, returnOf(path, 2), false);
  EXPECT_LT(deviation(closed[80]), 0.5 * deviation(open[80]));
  for (const size_t i : {20, 40, 70}) EXPECT_LT(deviation(closed[i]), deviation(open[i])) << i;
  EXPECT_EQ(ofPoses(path, {}, returnOf(path, 40), false)[80], open[80]) << "contradicted";
}

TEST(PathCovariance, HoldsTheSpreadOfTheParticles) {
  const auto path = thereAndBack();
  std::vector<PoseCovariance> particles(path.size(), PoseCovariance::Zero());
  particles[10] = PoseCovariance::Identity();
  const auto all = ofPoses(path, particles, {}, true), none = ofPoses(path, {}, {}, true);
  EXPECT_NEAR((all[10] - none[10] - PoseCovariance::Identity()).norm(), 0, 1e-12);
  EXPECT_EQ(all[11], none[11]);
}

TEST(PathCovariance, BetweenTwoPosesOfAStraightPath) {
  const auto path = thereAndBack();
  const PoseCovariance covariance =
      PathCovariances(path, {}, {}, true, true).between({10, path[10]}, {30, path[30]});
  const double drift = 16e-6 * 10, match = 1e-4;  // m^2, over 10 m
  const double turnOfStep = 0.5 * std::pow(0.008 * kDegree, 2), turnOfMatch = std::pow(0.09 * kDegree, 2);
  double moment = 0, squares = 0;
  for (double lever = 0; lever < 10; lever += 0.5) moment += lever, squares += lever * lever;
  PoseCovariance expected = Eigen::Vector3d(drift, drift, 20 * turnOfStep).asDiagonal();
  expected += 2 * Eigen::Vector3d(match, match, turnOfMatch).asDiagonal().toDenseMatrix();
  expected(1, 1) += turnOfStep * squares + turnOfMatch * 10 * 10;
  expected(1, 2) = expected(2, 1) = turnOfStep * moment + turnOfMatch * 10;
  EXPECT_LT((covariance - expected).cwiseAbs().maxCoeff(), 1e-12) << covariance << "\n\n" << expected;
}

TEST(PathCovariance, BetweenTwoPosesOfALoop) {
  const auto path = thereAndBack();
  const PathCovariances covariances(path, {}, returnOf(path, 2), false, true);
  // From x = 5 m out and back to x = 5 m: 30 m, or by the start, where the path ends: 10 m and a match.
  const double drift = std::pow(0.038 * kDegree, 2), match = std::pow(0.09 * kDegree, 2);
  const PathPoint out{10, path[10]}, back{70, path[70]};
  const PoseCovariance there = covariances.between(out, back), here = covariances.between(back, out);
  EXPECT_NEAR(here(0, 0), there(0, 0), 1e-12);
  EXPECT_NEAR(there(0, 0), 1 / (1 / (30 * 25e-6) + 1 / (10 * 25e-6 + 1e-4)) + 2e-4, 1e-6);
  // As the places of the two ways agree, too, the heading is known better than by the two headings alone.
  EXPECT_LT(there(2, 2), 1 / (1 / (30 * drift) + 1 / (10 * drift + match)) + 2 * match);
}

TEST(PathCovariance, APathThatIsNotRelaxedHasTheDriftOfTheShorterWay) {
  const auto path = thereAndBack();
  const PathCovariances covariances(path, {}, returnOf(path, 2), true, false);
  // The same: 10 m and a match.
  const double heading = 10 * std::pow(0.019 * kDegree, 2) + 3 * std::pow(0.09 * kDegree, 2);
  const PathPoint out{10, path[10]}, back{70, path[70]};
  EXPECT_NEAR(covariances.between(out, back)(2, 2), heading, 1e-12);
  EXPECT_NEAR(covariances.between(out, back)(0, 0), 10e-4 + 3e-4, 1e-4);
  EXPECT_NEAR(covariances.ofPoses()[40](2, 2),
              20 * std::pow(0.019 * kDegree, 2) + std::pow(0.09 * kDegree, 2), 1e-12)
      << "the first pose adds nothing";
}

TEST(PathCovariance, BetweenTwoPosesIsInTheFrameOfTheFirst) {
  auto path = thereAndBack();
  const auto returning = returnOf(path, 2);
  const auto between = [&](size_t from, size_t to) {
    return PathCovariances(path, {}, returning, false, true).between({from, path[from]}, {to, path[to]});
  };
  const PoseCovariance ahead = between(0, 30), behind = between(45, 60), closed = between(12, 72);
  for (TPose2D& pose : path) pose = TPose2D(7, -3, 2) + pose;
  EXPECT_TRUE(between(0, 30).isApprox(ahead, 1e-9));
  EXPECT_TRUE(between(45, 60).isApprox(behind, 1e-9));
  EXPECT_TRUE(between(12, 72).isApprox(closed, 1e-9));
}

TEST(PathCovariance, BetweenTwoPosesHoldsTheMotionSinceTheirUpdates) {
  const auto path = thereAndBack();
  const PathCovariances covariances(path, {}, {}, true, true);
  const PoseCovariance more = covariances.between({10, path[10]}, {30, {15.25, 0, 0}}) -
                              covariances.between({10, path[10]}, {30, {15, 0, 0}});
  EXPECT_NEAR(more(0, 0), 0.25 * 4e-4, 1e-12);
  EXPECT_NEAR(more(2, 2), 0.25 * kDegree * kDegree, 1e-12);
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
