#include "slam/filter/FilterView.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hybrid_slam {
namespace {

FilterStep spreadOf(const std::vector<WeightedPose>& poses, double heading) {
  FilterStep step;
  setSpread(step, poses, heading);
  return step;
}

TEST(FilterView, EquallyWeightedPosesByHand) {
  // x: -1, 1; y: 0, 4; phi: 0.2, 0.4: deviations 1, 2 and 0.1 from the mean.
  const FilterStep step = spreadOf({{{-1, 0, 0.2}, 0}, {{1, 4, 0.4}, 0}}, 0);
  EXPECT_NEAR(step.stdX, 1, 1e-12);
  EXPECT_NEAR(step.stdY, 2, 1e-12);
  EXPECT_NEAR(step.stdPhi, 0.1, 1e-12);
  EXPECT_NEAR(step.stdAlong, 1, 1e-12);
  EXPECT_NEAR(step.stdAcross, 2, 1e-12);
}

TEST(FilterView, AlongAndAcrossTurnWithTheHeading) {
  const std::vector<WeightedPose> poses = {{{-1, 0, 0}, 0}, {{1, 4, 0}, 0}};
  const FilterStep left = spreadOf(poses, M_PI / 2);
  EXPECT_NEAR(left.stdAlong, 2, 1e-12);
  EXPECT_NEAR(left.stdAcross, 1, 1e-12);
  // Along the line that joins the poses, the whole spread is along.
  const FilterStep joined = spreadOf(poses, std::atan2(4, 2));
  EXPECT_NEAR(joined.stdAlong, std::sqrt(5), 1e-12);
  EXPECT_NEAR(joined.stdAcross, 0, 1e-9);
}

TEST(FilterView, WeightsCountByTheirRatios) {
  // Weights 3 : 1 at x = 0 and 4: mean 1, variance (3 * 1 + 1 * 9) / 4 = 3.
  for (const double offset : {0.0, -5000.0, 5000.0}) {
    const FilterStep step = spreadOf({{{0, 0, 0}, std::log(3) + offset}, {{4, 0, 0}, offset}}, 0);
    EXPECT_NEAR(step.stdX, std::sqrt(3), 1e-9) << offset;
  }
}

TEST(FilterView, HeadingsAcrossTheWrapAreNeighbours) {
  const FilterStep step = spreadOf({{{0, 0, M_PI - 0.1}, 0}, {{0, 0, -M_PI + 0.1}, 0}}, 0);
  EXPECT_NEAR(step.stdPhi, 0.1, 1e-12);
}

TEST(FilterView, OnePoseHasNoSpreadAndNoPoseChangesNothing) {
  const FilterStep one = spreadOf({{{3, 4, 1}, -7}}, 1);
  EXPECT_EQ(one.stdX, 0);
  EXPECT_EQ(one.stdAcross, 0);
  EXPECT_EQ(spreadOf({}, 0).stdX, 0);
}

TEST(Place, IsDescribedInAFewWords) {
  EXPECT_EQ(describe(Place{true, true, 0}), "localised");
  EXPECT_EQ(describe(Place{false, false, 12}), "start unknown: 12 hypotheses");
  EXPECT_EQ(describe(Place{false, true, 3}), "place lost: 3 hypotheses");
}

}  // namespace
}  // namespace hybrid_slam
