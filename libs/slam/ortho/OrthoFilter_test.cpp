#include "slam/ortho/OrthoFilter.h"

#include <gtest/gtest.h>

#include "slam/lines/WallDirections.h"
#include "testing/FilteredDrive.h"
#include "testing/TestRoom.h"

namespace hybrid_slam {
namespace {

using namespace test;

TEST(OrthoFilter, CorrectsTheOdometryAroundARing) {
  OrthoFilter filter{FilterConfiguration(), OrthoOptions()};
  const FilteredDrive mapped = filtered(filter, ringDrive(0.3 * kDegree));
  EXPECT_GT(rms(mapped.odometry, mapped.truth), 3);
  EXPECT_LT(rms(mapped.path, mapped.truth), 0.2);
  EXPECT_NEAR(mapped.path.back().phi, mapped.truth.back().phi, 0.5 * kDegree);
  const FilterStep& last = filter.lastStep();
  EXPECT_EQ(last.particles, 1u);
  EXPECT_GT(last.linesSeen, 1);
  EXPECT_GT(last.linesMatched, 1);
  ASSERT_EQ(last.frames.size(), 1u);
  EXPECT_NEAR(last.frames[0].direction, 0, 0.3 * kDegree);
  for (const DatabaseLine& line : filter.bestLines())
    EXPECT_NEAR(rightAngleDifference(wrapToRightAngle(line.theta), last.frames[0].direction), 0, 1e-9);
  const auto grid = filter.bestGrid();
  EXPECT_GT(grid.getPos(10, 0), 0.6);
  EXPECT_GT(grid.getXMax() - grid.getXMin(), 36);
}

TEST(OrthoFilter, SpreadIsThatOfTheState) {
  OrthoFilter filter{FilterConfiguration(), OrthoOptions()};
  std::vector<DrivenPose> drive = ringDrive(0);
  drive.resize(40);
  filtered(filter, drive);
  const auto points = filter.particlePoses();
  ASSERT_EQ(points.size(), 6u);
  double x = 0, xx = 0;
  for (const auto& point : points) x += point.pose.x / 6;
  for (const auto& point : points) xx += std::pow(point.pose.x - x, 2) / 6;
  EXPECT_NEAR(x, filter.bestPath().back().x, 1e-9);
  EXPECT_NEAR(filter.lastStep().stdX, std::sqrt(xx), 1e-9);
  EXPECT_GT(filter.lastStep().stdX, 0);
}

TEST(OrthoFilter, ScansWithoutLinesLeaveTheOdometry) {
  std::vector<DrivenPose> drive = ringDrive(0.3 * kDegree);
  drive.resize(60);
  for (size_t i = 0; i < drive.size(); ++i)
    for (size_t k = 0; k < drive[i].scans[0].beams.size(); ++k) {
      Beam& beam = drive[i].scans[0].beams[k];
      if (i % 2)
        beam.valid = false;
      else
        beam.range = 1 + static_cast<double>(k * 7 % 11);  // scattered
    }
  OrthoFilter filter{FilterConfiguration(), OrthoOptions()};
  const FilteredDrive mapped = filtered(filter, drive);
  EXPECT_LT(rms(mapped.path, mapped.odometry), 1e-6);
  EXPECT_TRUE(filter.bestLines().empty());
  EXPECT_TRUE(filter.lastStep().frames.empty());
}

TEST(OrthoFilter, OdometryOfAnySizeStaysFinite) {
  OrthoFilter filter{FilterConfiguration(), OrthoOptions()};
  const DrivenPose driven = ringDrive(0)[0];
  for (const TPose2D& odometry :
       {TPose2D(), TPose2D(1e5, -1e5, 3), TPose2D(0, 0, 3.1), TPose2D(-1e5, 1e5, -3)})
    filter.process(odometry, observed(driven.scans[0]));
  for (const TPose2D& pose : filter.bestPath())
    EXPECT_TRUE(std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.phi));
  filter.process({0.2, 0, 0}, {});  // no scan: only the odometry counts
  EXPECT_EQ(filter.updates(), 4u);
}

}  // namespace
}  // namespace hybrid_slam
