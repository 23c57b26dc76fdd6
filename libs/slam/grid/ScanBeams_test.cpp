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
  EXPECT_EQ(ranges(ScanBeams(scan, {1, 4, 11})), (std::vector<double>{2, 5, 12}));
  const ScanBeams beams(scan);
  EXPECT_EQ(beams.originX, 0.2);
  EXPECT_EQ(beams.originY, 0.1);
  EXPECT_NEAR(beams.rays[1].dirX, std::cos(M_PI / 2 + 0.1), 1e-12);
  EXPECT_NEAR(beams.rays[1].dirY, std::sin(M_PI / 2 + 0.1), 1e-12);
}

}  // namespace
}  // namespace hybrid_slam
