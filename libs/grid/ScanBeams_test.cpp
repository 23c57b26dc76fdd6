#include "grid/ScanBeams.h"

#include <gtest/gtest.h>

namespace hybrid_slam {
namespace {

TEST(BeamStep, LeavesAboutSoManyBeams) {
  EXPECT_EQ(beamStep(541, 90), 6u);
  EXPECT_EQ(beamStep(181, 90), 2u);
  EXPECT_EQ(beamStep(180, 90), 2u);
  EXPECT_EQ(beamStep(130, 90), 1u);
  EXPECT_EQ(beamStep(10, 90), 1u);
  EXPECT_EQ(beamStep(0, 90), 1u);
  EXPECT_EQ(beamStep(541, 1), 541u);
  EXPECT_EQ(beamStep(541, 0), 1u);
  for (int beams = 1; beams < 200; ++beams) {
    const double left = 1000.0 / static_cast<double>(beamStep(1000, beams));
    EXPECT_GT(left, beams / 1.5);
    EXPECT_LT(left, beams * 1.5);
  }
}

TEST(ScanBeams, AreTheValidOnesAmongThoseTaken) {
  LaserScan scan;
  scan.sensorPose = {0.2, 0.1, M_PI / 2};
  for (int i = 0; i < 12; ++i) scan.beams.push_back({0.1 * i, 1.0 + i, i % 4 != 2});
  const auto ranges = [](const ScanBeams& beams) {
    std::vector<double> all;
    for (const auto& ray : beams.rays) all.push_back(ray.range);
    return all;
  };
  EXPECT_EQ(ranges(ScanBeams(scan)), (std::vector<double>{1, 2, 4, 5, 6, 8, 9, 10, 12}));
  EXPECT_EQ(ranges(ScanBeams(scan, 4)),
            (std::vector<double>{1, 4, 10}));  // every third, the 7th is not valid
  const ScanBeams beams(scan);
  EXPECT_EQ(beams.originX, 0.2);
  EXPECT_EQ(beams.originY, 0.1);
  EXPECT_NEAR(beams.rays[1].dirX, std::cos(M_PI / 2 + 0.1), 1e-12);
  EXPECT_NEAR(beams.rays[1].dirY, std::sin(M_PI / 2 + 0.1), 1e-12);
}

}  // namespace
}  // namespace hybrid_slam
