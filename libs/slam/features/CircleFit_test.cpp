#include "slam/features/CircleFit.h"

#include <gtest/gtest.h>

#include "testing/TestLines.h"

namespace hybrid_slam {
namespace {

using namespace test;

std::vector<TPoint2D> arc(const TPoint2D& centre, double radius, double angle, int n, double noise,
                          RandomStream& random) {
  std::vector<TPoint2D> points;
  for (int i = 0; i < n; ++i) {
    const double at = angle * i / (n - 1), r = radius + noise * random.gaussian();
    points.emplace_back(centre.x + r * std::cos(at), centre.y + r * std::sin(at));
  }
  return points;
}

TEST(CircleFit, IsExactOnACircle) {
  RandomStream random(1, 0, 0);
  for (const double radius : {0.05, 1.0, 20.0})
    for (const double angle : {0.5, M_PI, 2 * M_PI}) {
      const auto points = arc({30, -7}, radius, angle, 40, 0, random);
      const auto circle = fitCircle(range(points));
      ASSERT_TRUE(circle);
      EXPECT_LT((circle->centre - TPoint2D(30, -7)).norm(), 1e-6 * radius);
      EXPECT_NEAR(circle->radius, radius, 1e-6 * radius);
      EXPECT_LT(circle->squares, 1e-12 * radius * radius);
    }
}

TEST(CircleFit, TheCofactorIsTheSpreadOfNoisyFits) {
  constexpr double kNoise = 0.01;
  RandomStream random(2, 0, 0);
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero(), expected = spread;
  constexpr int kFits = 1000;
  for (int i = 0; i < kFits; ++i) {
    const auto points = arc({2, 1}, 0.5, 2, 60, kNoise, random);
    const auto circle = fitCircle(range(points));
    ASSERT_TRUE(circle);
    const Eigen::Vector3d off(circle->centre.x - 2, circle->centre.y - 1, circle->radius - 0.5);
    spread += off * off.transpose() / kFits;
    expected += kNoise * kNoise * circle->cofactor / kFits;
  }
  EXPECT_LT((spread - expected).norm(), 0.15 * expected.norm());
}

TEST(CircleFit, PointsWithoutACircleHaveNone) {
  RandomStream random(3, 0, 0);
  EXPECT_FALSE(fitCircle({}));
  const auto three = arc({0, 0}, 1, 1, 3, 0, random);
  EXPECT_FALSE(fitCircle(range(three)));
  const std::vector<TPoint2D> equal(9, TPoint2D(1, 2));
  EXPECT_FALSE(fitCircle(range(equal)));
  const auto line = pointsOnLine(2, 0.3, -1, 1, 50, 0, random);
  EXPECT_FALSE(fitCircle(range(line)));
}

}  // namespace
}  // namespace hybrid_slam
