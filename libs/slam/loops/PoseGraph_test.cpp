#include "slam/loops/PoseGraph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/Degree.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPose2D;

const Eigen::Matrix3d kMatch = Eigen::Vector3d(400, 400, 1e4).asDiagonal();  // 5 cm, 0.6 deg

/// A circle of 100 motions of 1 m whose headings drift by 0.1 deg each.
struct Ring {
  std::vector<TPose2D> truth;
  PoseGraph graph;
  Ring() {
    truth.emplace_back();
    graph.poses.emplace_back();
    for (size_t i = 1; i <= 100; ++i) {
      truth.push_back(truth.back() + TPose2D(1, 0, 3.6 * kDegree));
      const TPose2D motion(1, 0, 3.7 * kDegree);
      graph.poses.push_back(graph.poses.back() + motion);
      graph.motions.push_back({i - 1, i, motion, Eigen::Vector3d(400, 400, 5e4).asDiagonal()});
    }
  }
  PoseEdge loop(size_t from, size_t to) const { return {from, to, truth[to] - truth[from], kMatch}; }
  double error(const std::vector<TPose2D>& poses) const {
    double largest = 0;
    for (size_t i = 0; i < poses.size(); ++i)
      largest = std::max(largest, std::hypot(poses[i].x - truth[i].x, poses[i].y - truth[i].y));
    return largest;
  }
};

TEST(PoseGraph, ClosesARingThatDrifts) {
  Ring ring;
  EXPECT_GT(ring.error(ring.graph.poses), 2);
  for (const size_t i : {0, 1, 2}) ring.graph.loops.push_back(ring.loop(i, 98 + i));
  const OptimizedGraph result = optimized(ring.graph);
  EXPECT_LT(ring.error(result.poses), 0.3);
  for (const bool isFalse : result.isFalse) EXPECT_FALSE(isFalse);
  EXPECT_EQ(result.poses[0], ring.graph.poses[0]);
}

TEST(PoseGraph, RejectsOneFalseLoopAmongTrueOnes) {
  Ring ring;
  for (const size_t i : {0, 1, 2}) ring.graph.loops.push_back(ring.loop(i, 98 + i));
  ring.graph.loops.push_back({20, 70, {0.5, 0, 0}, kMatch});
  const OptimizedGraph result = optimized(ring.graph);
  EXPECT_LT(ring.error(result.poses), 0.4);
  EXPECT_TRUE(result.isFalse[3]);
  for (size_t i = 0; i < 3; ++i) EXPECT_FALSE(result.isFalse[i]);
}

TEST(PoseGraph, TwoFalseLoopsEndTheSearch) {
  Ring ring;
  for (const size_t i : {0, 1, 2}) ring.graph.loops.push_back(ring.loop(i, 98 + i));
  for (const double x : {0.5, 5.0, -5.0}) ring.graph.loops.push_back({20, 70, {x, 0, 0}, kMatch});
  const std::vector<bool> isFalse = optimized(ring.graph).isFalse;
  EXPECT_EQ(std::count(isFalse.begin(), isFalse.end(), true), 2);
}

/// A motion that is certain across and a loop that is certain along the first pose's heading. The solution is
/// their mean weighted by information in the frame of the first pose, for every heading of the second.
TEST(PoseGraph, InformationIsInTheFrameOfTheFirstPose) {
  Eigen::Matrix3d motion, loop;
  motion << 40, 30, 20, 30, 900, 50, 20, 50, 1e4;
  loop << 700, -60, 40, -60, 30, -10, 40, -10, 2e4;
  for (int degrees = -180; degrees < 180; degrees += 45) {
    SCOPED_TRACE(degrees);
    const double phi = degrees * kDegree;
    const Eigen::Vector3d moved(2, 0, phi), seen(2.02, 0.03, phi + 0.002);
    PoseGraph graph;
    graph.poses = {{}, {moved[0], moved[1], moved[2]}};
    graph.motions = {{0, 1, graph.poses[1], motion}};
    graph.loops = {{0, 1, {seen[0], seen[1], seen[2]}, loop}};
    const Eigen::Vector3d expected = (motion + loop).ldlt().solve(motion * moved + loop * seen);
    const OptimizedGraph result = optimized(graph);
    EXPECT_NEAR(result.poses[1].x, expected[0], 1e-9);
    EXPECT_NEAR(result.poses[1].y, expected[1], 1e-9);
    EXPECT_NEAR(std::remainder(result.poses[1].phi - expected[2], 2 * M_PI), 0, 1e-9);
    EXPECT_EQ(result.isFalse, std::vector<bool>{false});
  }
}

// Two poses, each seen in the map: no pose is fixed.
TEST(PoseGraph, PosesSeenInTheMapMoveAllOthers) {
  const Eigen::Matrix3d information = Eigen::Vector3d(400, 400, 2500).asDiagonal();
  PoseGraph graph;
  graph.poses = {{}, {1, 0, 0}, {2, 0, 0}};
  graph.motions = {{0, 1, {1, 0, 0}, information}, {1, 2, {1, 0, 0}, information}};
  const TPose2D middle(5, -3, M_PI / 2);
  graph.loops = {{PoseEdge::kMapFrame, 1, middle, information}};
  const OptimizedGraph single = optimized(graph);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(single.poses[i].x, 5, 1e-6) << i;
    EXPECT_NEAR(single.poses[i].y, -4 + static_cast<double>(i), 1e-6) << i;
    EXPECT_NEAR(single.poses[i].phi, M_PI / 2, 1e-6) << i;
  }
  // The second is 0.3 m further along the path: two measurements and a motion, of equal weight, share this.
  graph.loops.push_back({PoseEdge::kMapFrame, 2, {5, -1.7, M_PI / 2}, information});
  const OptimizedGraph both = optimized(graph);
  EXPECT_NEAR(both.poses[1].y, -2.9, 1e-6);
  EXPECT_NEAR(both.poses[2].y, -1.8, 1e-6);
  EXPECT_NEAR(both.poses[0].y, -3.9, 1e-6);
}

TEST(PoseGraph, WithoutLoopsNothingMoves) {
  const Ring ring;
  const OptimizedGraph result = optimized(ring.graph);
  for (size_t i = 0; i < result.poses.size(); ++i)
    EXPECT_LT(
        std::hypot(result.poses[i].x - ring.graph.poses[i].x, result.poses[i].y - ring.graph.poses[i].y),
        1e-6);
}

}  // namespace
}  // namespace hybrid_slam
