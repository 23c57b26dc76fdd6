#include "study/evaluation/AbsoluteTrajectoryError.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/RandomStream.h"
#include "testing/ErrorOf.h"

namespace hybrid_slam::evaluation {
namespace {

using mrpt::math::TPose2D;

TPose2D randomPose(RandomStream& random) {
  return {20 * random.gaussian(), 20 * random.gaussian(), M_PI * (2 * random.uniform() - 1)};
}

files::Trajectory randomTrajectory(RandomStream& random, size_t poses) {
  files::Trajectory t;
  for (size_t i = 0; i < poses; ++i) t.push_back({static_cast<double>(i), randomPose(random)});
  return t;
}

files::Trajectory movedTrajectory(const TPose2D& motion, files::Trajectory t) {
  for (files::StampedPose& p : t) p.pose = motion + p.pose;
  return t;
}

files::Trajectory noisy(RandomStream& random, double sigma, files::Trajectory t) {
  for (files::StampedPose& p : t) {
    p.pose.x += sigma * random.gaussian();
    p.pose.y += sigma * random.gaussian();
  }
  return t;
}

files::Trajectory alongX(const std::vector<double>& xs) {
  files::Trajectory t;
  for (const double x : xs) t.push_back({static_cast<double>(t.size()), {x, 0, 0}});
  return t;
}

TEST(AbsoluteTrajectoryError, ByHand) {
  // Symmetric about the origin, so that the alignment is the identity: errors 0.3, 0, 0, 0.3.
  const AteErrors e = absoluteTrajectoryError(alongX({-2.3, -1, 1, 2.3}), alongX({-2, -1, 1, 2}), 0.01);
  EXPECT_EQ(e.pairs, 4u);
  EXPECT_NEAR(e.translation.mean, 0.15, 1e-12);
  EXPECT_NEAR(e.translation.rmse, std::sqrt(0.045), 1e-12);
  EXPECT_NEAR(e.translation.std, 0.15, 1e-12);
  EXPECT_NEAR(e.translation.median, 0.3, 1e-12);
  EXPECT_NEAR(e.translation.max, 0.3, 1e-12);
}

TEST(AbsoluteTrajectoryError, DoesNotScale) {
  // Twice as long: after alignment each end is off by half the difference.
  const AteErrors e = absoluteTrajectoryError(alongX({0, 4}), alongX({0, 2}), 0.01);
  EXPECT_NEAR(e.translation.rmse, 1, 1e-12);
  EXPECT_NEAR(e.translation.max, 1, 1e-12);
}

TEST(AbsoluteTrajectoryError, FindsAnyRigidMotion) {
  RandomStream random(4, 0, 0);
  for (int trial = 0; trial < 200; ++trial) {
    const files::Trajectory reference = randomTrajectory(random, 2 + trial % 20);
    const TPose2D motion = randomPose(random);
    const AteErrors e =
        absoluteTrajectoryError(movedTrajectory(TPose2D() - motion, reference), reference, 0.01);
    EXPECT_LT(e.translation.max, 1e-11);
    EXPECT_NEAR(e.alignment.x, motion.x, 1e-10);
    EXPECT_NEAR(e.alignment.y, motion.y, 1e-10);
    EXPECT_NEAR(std::cos(e.alignment.phi - motion.phi), 1, 1e-12);
  }
}

TEST(AbsoluteTrajectoryError, IsInvariantUnderRigidMotionOfTheEstimate) {
  RandomStream random(5, 0, 0);
  for (int trial = 0; trial < 200; ++trial) {
    const files::Trajectory reference = randomTrajectory(random, 30);
    const files::Trajectory estimate = noisy(random, 0.5, reference);
    const ErrorStatistics a = absoluteTrajectoryError(estimate, reference, 0.01).translation;
    const ErrorStatistics b =
        absoluteTrajectoryError(movedTrajectory(randomPose(random), estimate), reference, 0.01).translation;
    EXPECT_GT(a.rmse, 0.1);
    EXPECT_NEAR(a.rmse, b.rmse, 1e-11);
    EXPECT_NEAR(a.mean, b.mean, 1e-11);
    EXPECT_NEAR(a.median, b.median, 1e-11);
    EXPECT_NEAR(a.std, b.std, 1e-11);
    EXPECT_NEAR(a.max, b.max, 1e-11);
  }
}

TEST(AbsoluteTrajectoryError, NoOtherRigidMotionIsBetter) {
  RandomStream random(6, 0, 0);
  for (int trial = 0; trial < 50; ++trial) {
    const files::Trajectory reference = randomTrajectory(random, 10);
    const auto pairs =
        associate(noisy(random, 2, movedTrajectory(randomPose(random), reference)), reference, 0.01);
    const auto squares = [&](const TPose2D& motion) {
      double sum = 0;
      for (const PosePair& p : pairs) {
        const TPose2D aligned = motion + p.estimate;
        sum += std::pow(aligned.x - p.reference.x, 2) + std::pow(aligned.y - p.reference.y, 2);
      }
      return sum;
    };
    const TPose2D best = rigidAlignment(pairs);
    for (int i = 0; i < 50; ++i) {
      const double size = std::pow(10, -4 * random.uniform());
      const TPose2D other{best.x + size * random.gaussian(), best.y + size * random.gaussian(),
                          best.phi + size * random.gaussian()};
      EXPECT_LT(squares(best), squares(other));
    }
  }
}

TEST(AbsoluteTrajectoryError, LeavesOutPosesWithoutAReferenceInTime) {
  files::Trajectory estimate = alongX({0, 1, 2});
  estimate.push_back({2.5, {1000, 1000, 0}});
  const AteErrors e = absoluteTrajectoryError(estimate, alongX({0, 1, 2}), 0.1);
  EXPECT_EQ(e.pairs, 3u);
  EXPECT_NEAR(e.translation.max, 0, 1e-12);
}

TEST(AbsoluteTrajectoryError, RobotThatStandsStillHasNoErrorAndAnyHeading) {
  const AteErrors e = absoluteTrajectoryError(alongX({3, 3, 3}), alongX({7, 7, 7}), 0.1);
  EXPECT_NEAR(e.translation.max, 0, 1e-12);
}

TEST(AbsoluteTrajectoryError, NeedsTwoPosesInCommon) {
  using testing::HasSubstr;
  const auto errorOf = [](const files::Trajectory& estimate, const files::Trajectory& reference) {
    return test::errorOf([&] { absoluteTrajectoryError(estimate, reference, 0.02); });
  };
  EXPECT_EQ(errorOf({{1, {}}, {2, {}}}, {{5.5, {}}, {4, {}}}),
            "the reference does not overlap the trajectory in time: trajectory 1.000..2.000 s, reference "
            "4.000..5.500 s; expected poses within 0.02 s of each other");
  EXPECT_THAT(errorOf({{1, {}}, {2, {}}}, {{1, {}}}), HasSubstr("only one common pose"));
  EXPECT_THAT(errorOf({}, {{1, {}}}), HasSubstr("trajectory without poses"));
  EXPECT_THAT(errorOf({{1, {}}}, {}), HasSubstr("reference without poses"));
}

}  // namespace
}  // namespace hybrid_slam::evaluation
