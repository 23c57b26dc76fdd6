#include "slam/loops/PathCorrection.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hybrid_slam {
namespace {

using mrpt::math::TPose2D;

/// An arc of 1 m steps that turn by 0.1 rad.
std::vector<TPose2D> arc() {
  std::vector<TPose2D> path{{}};
  while (path.size() < 11) path.push_back(path.back() + TPose2D(1, 0, 0.1));
  return path;
}

void expectNear(const TPose2D& a, const TPose2D& b) {
  EXPECT_NEAR(a.x, b.x, 1e-12);
  EXPECT_NEAR(a.y, b.y, 1e-12);
  EXPECT_NEAR(std::remainder(a.phi - b.phi, 2 * M_PI), 0, 1e-12);
}

TEST(PathCorrection, ARigidMotionOfTheNodesMovesThePathRigidly) {
  const auto path = arc();
  const TPose2D by(3, -2, 3);
  const auto result = corrected(path, {0, 4, 7}, {by + path[0], by + path[4], by + path[7]});
  ASSERT_EQ(result.size(), path.size());
  for (size_t i = 0; i < path.size(); ++i) expectNear(result[i], by + path[i]);
}

TEST(PathCorrection, TheChangeBetweenTwoNodesIsDistributedByIndex) {
  const auto path = arc();
  TPose2D moved = path[4];
  moved.x += 0.4, moved.y -= 0.8, moved.phi += 0.2;
  const auto result = corrected(path, {0, 4}, {path[0], moved});
  for (size_t i = 0; i <= 4; ++i) {
    const double share = static_cast<double>(i) / 4;
    expectNear(result[i], {path[i].x + share * 0.4, path[i].y - share * 0.8, path[i].phi + share * 0.2});
  }
  for (size_t i = 4; i < path.size(); ++i) expectNear(result[i], moved + (path[i] - path[4]));
}

TEST(PathCorrection, AnEmptyPathStaysEmpty) { EXPECT_TRUE(corrected({}, {}, {}).empty()); }

}  // namespace
}  // namespace hybrid_slam
