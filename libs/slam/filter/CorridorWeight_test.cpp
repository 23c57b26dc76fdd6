// Scans of a corridor show little of the position along it.
#include <gtest/gtest.h>

#include "slam/filter/HybridFilter.h"
#include "testing/RingDrive.h"

namespace hybrid_slam {
namespace {

using namespace test;

/// The end, along x, of the path that the filter finds for a drive of 60 m along a plain corridor, with exact
/// odometry.
double endWith(const FilterConfiguration& configuration) {
  HybridFilter filter(configuration);
  for (const DrivenPose& step : driveAlong(box(-30, -1.2, 130, 1.2), {{0, 0}, {60, 0}}, 0))
    filter.process(step.motion, observed(step.scans[0]));
  return filter.bestPath().back().x;
}

// Scans fit better a little behind their true pose, where their beams hit the cells of the scans before.
TEST(CorridorWeight, KeepsTheLengthOfACorridor) {
  FilterConfiguration c;
  const double weighted = endWith(c);
  EXPECT_GT(weighted, 58.5);
  c.improved.corridorWeight = 1;
  EXPECT_LT(endWith(c), weighted - 0.5);
}

// Without lines, the heading in a corridor depends on the beams.
TEST(CorridorWeight, NeedsLines) {
  FilterConfiguration c;
  c.useLines = false;
  const double end = endWith(c);
  c.improved.corridorWeight = 1;
  EXPECT_EQ(endWith(c), end);
}

}  // namespace
}  // namespace hybrid_slam
