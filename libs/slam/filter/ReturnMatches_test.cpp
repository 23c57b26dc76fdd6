#include "slam/filter/ReturnMatches.h"

#include <gtest/gtest.h>

#include <cmath>

#include "testing/RingDrive.h"

namespace hybrid_slam {
namespace {

using namespace test;

/// The true path of a drive whose map frame is turned, and its scans.
struct TruePath {
  std::vector<TPose2D> path;
  std::vector<Scans> scans;
  std::vector<size_t> nodes;  ///< every second pose

  TruePath(const std::vector<DrivenPose>& drive, double turn) {
    for (const DrivenPose& step : drive) {
      if (path.size() % 2 == 0) nodes.push_back(path.size());
      path.push_back(TPose2D(7, -3, turn) + step.truth);
      scans.push_back(observed(step.scans[0]));
    }
  }
  std::vector<PoseEdge> edges() const {
    const FilterConfiguration configuration;
    return returnMatches(PathScans(path, scans, configuration), nodes, 1);
  }
};

TEST(ReturnMatches, AreTheTrueMotions) {
  for (const double turn : {0.0, 0.7, -2.0}) {
    const TruePath lap(ringDrive(0), turn);
    const std::vector<PoseEdge> edges = lap.edges();
    ASSERT_GT(edges.size(), 20u);
    for (const PoseEdge& edge : edges) {
      const TPose2D truth = lap.path[lap.nodes[edge.to]] - lap.path[lap.nodes[edge.from]];
      EXPECT_LT((edge.relative - truth).norm(), 0.05) << edge.to;
      EXPECT_LT(edge.from, edge.to);
    }
  }
}

/// A bare corridor shows the position across it and the heading, but not the position along it. The frame of
/// an edge is that of the earlier pose, whose x axis is along the corridor, so its information on x is the
/// smallest in any map frame.
TEST(ReturnMatches, TheirInformationIsInTheFrameOfTheEarlierPose) {
  for (const double turn : {0.0, 0.7, M_PI / 2, -2.0}) {
    const TruePath there(driveAlong(box(-60, -1.5, 100, 1.5), {{0, 0}, {40, 0}, {10, 0}}, 0), turn);
    const std::vector<PoseEdge> edges = there.edges();
    ASSERT_GT(edges.size(), 10u);
    size_t compared = 0;
    for (const PoseEdge& edge : edges) {
      const TPose2D& earlier = there.path[there.nodes[edge.from]];
      if (std::abs(std::sin(earlier.phi - turn)) > 0.01) continue;  // while the robot turned
      EXPECT_GT(edge.information(1, 1), 3 * edge.information(0, 0)) << turn << ", node " << edge.to;
      ++compared;
    }
    EXPECT_GT(compared, 10u);
  }
}

}  // namespace
}  // namespace hybrid_slam
