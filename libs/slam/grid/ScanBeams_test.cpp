#include "slam/grid/ScanBeams.h"

#include <gtest/gtest.h>

namespace hybrid_slam {
namespace {

TEST(ScanBeams, AreTheValidOnesInTheRobotsFrame) {
  LaserScan scan;
  scan.sensorPose = {0.2, 0.1, M_PI / 2};
  for (int i = 0; i < 12; ++i) scan.beams.push_back({0.1 * i, 1.0 + i, i % 4 != 2});
  const auto ranges = [](const ScanBeams& beams) {
    std::vector<double> all;
    for (const auto& ray : beams.rays) all.push_back(ray.range);
    return all;
  };
  EXPECT_EQ(ranges(ScanBeams(scan)), (std::vector<double>{1, 2, 4, 5, 6, 8, 9, 10, 12}));
  EXPECT_EQ(ranges(ScanBeams({scan}, {1, 4, 11})), (std::vector<double>{2, 5, 12}));
  const ScanBeams beams(scan);
  EXPECT_EQ(beams.origins.at(0).x, 0.2);
  EXPECT_EQ(beams.origins.at(0).y, 0.1);
  EXPECT_NEAR(beams.rays[1].dirX, std::cos(M_PI / 2 + 0.1), 1e-12);
  EXPECT_NEAR(beams.rays[1].dirY, std::sin(M_PI / 2 + 0.1), 1e-12);
}

/// There are two lasers, the second facing backwards with other beams: every beam starts at its laser.
TEST(ScanBeams, EachBeamStartsAtItsLaser) {
  LaserScan front, rear;
  front.sensorPose = {0.3, 0, 0};
  front.beams = {{-0.5, 2, true}, {0.5, 3, false}, {0.7, 4, true}};
  rear.sensorPose = {-0.3, 0.1, M_PI};
  rear.beams = {{0.1, 5, true}};
  const ScanBeams all(LaserScans{front, rear}), some({front, rear}, {2, 3});
  ASSERT_EQ(all.rays.size(), 3u);
  ASSERT_EQ(some.rays.size(), 2u);
  for (const auto& [beams, ray, laser] :
       {std::tuple(&all, 1, 0u), std::tuple(&all, 2, 1u), std::tuple(&some, 0, 0u), std::tuple(&some, 1, 1u)})
    EXPECT_EQ(beams->rays[static_cast<size_t>(ray)].laser, laser);

  const mrpt::math::TPose2D robot(4, -2, 0.8);
  const GridPose pose(robot, all, 0.05);
  for (const auto& ray : all.rays) {
    const LaserScan& scan = ray.laser == 0 ? front : rear;
    const auto expected = robot.composePoint({scan.sensorPose.x, scan.sensorPose.y});
    EXPECT_NEAR(pose.origin(ray).x, expected.x / 0.05, 1e-9);
    EXPECT_NEAR(pose.origin(ray).y, expected.y / 0.05, 1e-9);
  }
  EXPECT_NEAR(pose.dirX(all.rays[2]), std::cos(0.8 + M_PI + 0.1), 1e-12);
}

}  // namespace
}  // namespace hybrid_slam
