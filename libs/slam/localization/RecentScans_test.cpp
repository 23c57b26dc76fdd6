#include "slam/localization/RecentScans.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/PoseOffset.h"
#include "testing/MappedRoom.h"
#include "testing/RingDrive.h"

namespace hybrid_slam {
namespace {

using namespace test;

/// Drives a circle in the room; in each step, the odometry's turn is too small by `error`.
struct Driven {
  explicit Driven(int steps, double error = 0) : recent(FilterConfiguration()) {
    RandomStream random(1, 0, 0);
    TPose2D robot(1, 0, 0);
    const TPose2D motion(0.3, 0, 15 * kDegree);
    recent.add({}, prepared(room(), robot, random));
    truth.push_back(robot);
    for (int i = 0; i < steps; ++i) {
      robot = robot + motion;
      if (recent.add({0.3, 0, motion.phi - error}, prepared(room(), robot, random))) truth.push_back(robot);
    }
  }
  RecentScans recent;
  std::vector<TPose2D> truth;  ///< of the scans added
};

TEST(RecentScans, TakesScansFarEnoughApart) {
  const Driven driven(10);
  EXPECT_EQ(driven.recent.scans().size(), 6);  // every second: 30 deg
  EXPECT_EQ(driven.recent.since(), TPose2D());
  EXPECT_LT(offsetOf(driven.recent.motion(5, 0), driven.truth[0] - driven.truth[5]).norm(), 0.06);
}

TEST(RecentScans, LeavesOutWhoWalksWhereTheScansBeforeSawFreeSpace) {
  RecentScans recent{FilterConfiguration()};
  RandomStream random(1, 0, 0);
  TPose2D robot(-1, 0, 0);
  for (int i = 0; i < 6; ++i, robot = robot + TPose2D(0.5, 0, 0)) {
    Walls walls = room();
    const TPoint2D at = robot.composePoint(TPoint2D(1, 0.3));
    if (i == 5) append(walls, box(at.x - 0.1, at.y - 0.1, at.x + 0.1, at.y + 0.1));
    recent.add({i == 0 ? 0 : 0.5, 0, 0}, prepared(walls, robot, random));
  }
  const PreparedScan& scan = recent.scans().back().scan;
  const auto shortest = [](const ScanBeams& beams) {
    return std::min_element(beams.rays.begin(), beams.rays.end(),
                            [](const auto& a, const auto& b) { return a.range < b.range; })
        ->range;
  };
  EXPECT_LT(shortest(scan.beams), 1.3);
  EXPECT_GT(shortest(scan.matchedBeams), 1.3);
}

TEST(RecentScans, ForgetsTheOldest) {
  Driven driven(200);
  EXPECT_EQ(driven.recent.scans().size(), 40);
  driven.recent.keep(3);
  ASSERT_EQ(driven.recent.scans().size(), 3);
  const auto& truth = driven.truth;
  EXPECT_LT(offsetOf(driven.recent.motion(0, 2), truth.back() - truth[truth.size() - 3]).norm(), 0.02);
}

TEST(RecentScans, CorrectTheOdometry) {
  const Driven driven(30, 1.5 * kDegree);
  const size_t last = driven.recent.scans().size() - 1;
  const auto off = offsetOf(driven.recent.motion(0, last), driven.truth[last] - driven.truth[0]);
  EXPECT_LT(off.head<2>().norm(), 0.1);
  EXPECT_LT(std::abs(off.z()), 5 * kDegree);  // 45 by the odometry
}

TEST(RecentScans, JoinedAreOneScanOfTheNewestPose) {
  const Driven driven(40);
  const ScanBeams joined = driven.recent.joined();
  EXPECT_EQ(joined.origins.size(), kMaxLasers);
  const TPose2D robot = driven.truth.back();
  for (const ScanBeams::Ray& ray : joined.rays) {
    const mrpt::math::TPoint2D from = robot.composePoint(joined.origins.at(ray.laser));
    const double seen = castRay(room(), from, robot.phi + std::atan2(ray.dirY, ray.dirX));
    EXPECT_NEAR(seen, ray.range, 0.3);
  }
  EXPECT_GE(driven.recent.lines().size(), kMaxLasers);
}

}  // namespace
}  // namespace hybrid_slam
