#include "study/comparison/ReturnError.h"

#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>

#include <cmath>

#include "base/Errors.h"

namespace hybrid_slam::comparison {
namespace {

TEST(ReturnError, ByHand) {
  // The reference comes back to its start, turned by 90 deg; the estimate misses it by (0.3, 0.4) and 2 deg.
  const files::Trajectory reference{{0, {5, 6, M_PI / 2}}, {1, {9, 9, 0}}, {2, {5, 6, M_PI}}};
  const files::Trajectory estimate{
      {0.01, {0, 0, 0}}, {1.01, {7, 7, 1}}, {2.01, {0.3, 0.4, M_PI / 2 + mrpt::DEG2RAD(2.0)}}};
  const ReturnError error = returnError(estimate, reference, 0.02);
  EXPECT_NEAR(error.translation, 0.5, 1e-12);
  EXPECT_NEAR(error.rotation * 180 / M_PI, 2, 1e-9);
}

TEST(ReturnError, DoesNotDependOnTheFramesNorOnWhatLiesOutsideTheReference) {
  const files::Trajectory reference{{1, {1, 2, 0.3}}, {2, {3, 1, 1}}, {3, {1.5, 2, -2}}};
  files::Trajectory estimate{
      {0, {0, 0, 0}}, {1, {1, 1, 0}}, {2, {2, 1, 1}}, {3, {1.2, 1, -2.2}}, {4, {50, 50, 1}}};
  const ReturnError before = returnError(estimate, reference, 0.02);
  for (files::StampedPose& p : estimate) p.pose = mrpt::math::TPose2D(-7, 3, 2.5) + p.pose;
  const ReturnError after = returnError(estimate, reference, 0.02);
  EXPECT_NEAR(before.translation, after.translation, 1e-12);
  EXPECT_NEAR(before.rotation, after.rotation, 1e-12);
  EXPECT_GT(before.translation, 0.1);
}

TEST(ReturnError, NoOverlapIsAnInputError) {
  EXPECT_THROW(returnError({{0, {}}}, {{10, {}}}, 0.02), InputError);
}

}  // namespace
}  // namespace hybrid_slam::comparison
