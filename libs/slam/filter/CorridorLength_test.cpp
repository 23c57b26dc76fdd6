// A plain corridor shows nothing of the position along it. Beams 1 deg apart leave gaps in the walls ahead,
// and a scan fits best where its beams hit the cells of the scans before, a little behind its true pose.
#include <gtest/gtest.h>

#include "slam/filter/HybridFilter.h"
#include "testing/RingDrive.h"

namespace hybrid_slam {
namespace {

using namespace test;

/// Returns the end, along x, of the path that the filter finds for a drive of 60 m along a plain corridor of
/// this width (m), with exact odometry.
double endOfDrive(const FilterConfiguration& configuration, double width) {
  HybridFilter filter(configuration);
  for (const DrivenPose& step : driveAlong(box(-30, -width / 2, 130, width / 2), {{0, 0}, {60, 0}}, 0))
    filter.process(step.motion, observed(step.scans[0]));
  return filter.bestPath().back().x;
}

TEST(CorridorLength, WallsBetweenBeamsKeepIt) {
  constexpr int kWidths = 5;
  double filled = 0, hitsAlone = 0;
  FilterConfiguration c;
  for (int i = 0; i < kWidths; ++i) {
    const double width = 2.4 + 0.15 * i;
    c.grid.wallGap = 1;
    filled += endOfDrive(c, width) / kWidths;
    c.grid.wallGap = 0;
    hitsAlone += endOfDrive(c, width) / kWidths;
  }
  EXPECT_NEAR(filled, 60, 1);
  EXPECT_LT(hitsAlone, 58.5);
}

}  // namespace
}  // namespace hybrid_slam
