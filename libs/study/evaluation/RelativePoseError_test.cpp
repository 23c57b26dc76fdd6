#include "study/evaluation/RelativePoseError.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/RandomStream.h"
#include "testing/ErrorOf.h"

namespace hybrid_slam::evaluation {
namespace {

using mrpt::math::TPose2D;
using Unit = RpeDelta::Unit;

/// A pose every 0.1 s and 0.05 m along x.
files::Trajectory straight(int poses) {
  files::Trajectory t;
  for (int i = 0; i < poses; ++i) t.push_back({i * 0.1, {i * 0.05, 0, 0}});
  return t;
}

void expectAll(const ErrorStatistics& s, double value, double tolerance) {
  EXPECT_NEAR(s.rmse, value, tolerance);
  EXPECT_NEAR(s.mean, value, tolerance);
  EXPECT_NEAR(s.median, value, tolerance);
  EXPECT_NEAR(s.max, value, tolerance);
}

TEST(RelativePoseError, ScaleDriftOnAStraightLine) {
  const files::Trajectory reference = straight(101);
  files::Trajectory estimate = reference;
  for (files::StampedPose& p : estimate) p.pose.x *= 1.03;
  const RpeErrors way = relativePoseError(estimate, reference, {1, Unit::metres}, 0.01);
  EXPECT_EQ(way.pairs, 81u);  // 20 steps make 1 m
  expectAll(way.translation, 0.03, 1e-12);
  expectAll(way.rotation, 0, 1e-12);
  const RpeErrors time = relativePoseError(estimate, reference, {2, Unit::seconds}, 0.01);
  EXPECT_EQ(time.pairs, 81u);  // 2 s at 0.5 m/s
  expectAll(time.translation, 0.03, 1e-12);
}

TEST(RelativePoseError, ScaleDriftOnACircleIsThatOfTheChord) {
  const int n = 720;  // over the whole circle of 3 m; the estimate's is 2 % larger
  files::Trajectory reference, estimate;
  for (int i = 0; i < n; ++i) {
    const double a = 2 * M_PI * i / n;
    reference.push_back({i * 0.1, {3 * std::sin(a), 3 - 3 * std::cos(a), a}});
    estimate.push_back({i * 0.1, {3.06 * std::sin(a), 3.06 - 3.06 * std::cos(a), a}});
  }
  const RpeErrors e = relativePoseError(estimate, reference, {12, Unit::seconds}, 0.01);  // 60 deg: chord 3 m
  EXPECT_EQ(e.pairs, 600u);
  expectAll(e.translation, 0.06, 1e-12);
  expectAll(e.rotation, 0, 1e-12);
}

TEST(RelativePoseError, DistanceIsAlongTheReferenceAlsoBetweenPosesFarApart) {
  files::Trajectory reference, sparse;
  for (int i = 0; i <= 400; ++i) {
    const double a = M_PI * i / 200;
    reference.push_back({i * 0.1, {std::sin(a), 1 - std::cos(a), a}});
    if (i % 100 == 0) sparse.push_back(reference.back());
  }
  EXPECT_EQ(relativePoseError(sparse, reference, {1.57, Unit::metres}, 0.01).pairs, 4u);
  EXPECT_THROW(relativePoseError(sparse, reference, {1.41, Unit::metres}, 0.01), InputError);
}

TEST(RelativePoseError, HeadingDriftPerMetre) {
  const files::Trajectory reference = straight(101);
  files::Trajectory estimate{reference[0]};
  for (int i = 1; i <= 100; ++i)
    estimate.push_back({i * 0.1, estimate.back().pose + TPose2D{0.05, 0, 0.001}});
  const RpeErrors e = relativePoseError(estimate, reference, {1, Unit::metres}, 0.01);
  expectAll(e.rotation, 0.02, 1e-12);
  EXPECT_NEAR(e.translation.std, 0, 1e-12) << "each stretch has the same error";
  EXPECT_GT(e.translation.mean, 0.005);
}

TEST(RelativePoseError, OneJumpByHand) {
  const files::Trajectory reference = straight(11);
  files::Trajectory estimate = reference;
  for (size_t i = 6; i < estimate.size(); ++i) estimate[i].pose.y += 0.4;
  // Stretches of 0.2 s: 0-2, 1-3, ..., 8-10; those from 4 and 5 hold the jump between 5 and 6.
  const RpeErrors e = relativePoseError(estimate, reference, {0.2, Unit::seconds}, 0.01);
  EXPECT_EQ(e.pairs, 9u);
  EXPECT_NEAR(e.translation.mean, 0.8 / 9, 1e-12);
  EXPECT_NEAR(e.translation.rmse, 0.4 * std::sqrt(2.0 / 9), 1e-12);
  EXPECT_NEAR(e.translation.median, 0, 1e-12);
  EXPECT_NEAR(e.translation.max, 0.4, 1e-12);
}

TEST(RelativePoseError, IsInvariantUnderRigidMotionOfEither) {
  RandomStream random(7, 0, 0);
  for (int trial = 0; trial < 50; ++trial) {
    files::Trajectory reference{{0, {}}}, estimate{{0, {}}};
    for (int i = 1; i < 60; ++i) {
      const TPose2D step{0.1 + 0.05 * random.uniform(), 0, 0.3 * random.gaussian()};
      const TPose2D wrong{step.x + 0.01 * random.gaussian(), step.y, step.phi + 0.01 * random.gaussian()};
      reference.push_back({i * 0.2, reference.back().pose + step});
      estimate.push_back({i * 0.2, estimate.back().pose + wrong});
    }
    const TPose2D a{random.gaussian(), random.gaussian(), random.gaussian()},
        b{random.gaussian(), random.gaussian(), random.gaussian()};
    files::Trajectory movedReference = reference, movedEstimate = estimate;
    for (files::StampedPose& p : movedReference) p.pose = a + p.pose;
    for (files::StampedPose& p : movedEstimate) p.pose = b + p.pose;
    const RpeErrors e = relativePoseError(estimate, reference, {1, Unit::seconds}, 0.01);
    const RpeErrors f = relativePoseError(movedEstimate, movedReference, {1, Unit::seconds}, 0.01);
    EXPECT_EQ(e.pairs, f.pairs);
    EXPECT_GT(e.translation.rmse, 1e-3);
    EXPECT_NEAR(e.translation.rmse, f.translation.rmse, 1e-12);
    EXPECT_NEAR(e.translation.max, f.translation.max, 1e-12);
    EXPECT_NEAR(e.rotation.rmse, f.rotation.rmse, 1e-12);
  }
}

TEST(RelativePoseError, OverTimeTheOrderOfTheRowsDoesNotMatter) {
  const files::Trajectory reference = straight(101);
  files::Trajectory estimate = reference;
  for (files::StampedPose& p : estimate) p.pose.x *= 1.03;
  std::swap(estimate[10], estimate[11]);
  std::swap(estimate[50], estimate[53]);
  const RpeErrors e = relativePoseError(estimate, reference, {2, Unit::seconds}, 0.01);
  EXPECT_EQ(e.pairs, 81u);
  expectAll(e.translation, 0.03, 1e-12);
}

TEST(RelativePoseError, DistanceFollowsThePathInFileOrder) {
  const files::Trajectory reference{
      {0, {0, 0, 0}}, {1, {1, 0, 0}}, {3, {1, 1, 0}}, {2, {0, 1, 0}}, {4, {0, 2, 0}}};
  files::Trajectory estimate = reference;
  estimate[3].pose.y += 0.3;
  const RpeErrors e = relativePoseError(estimate, reference, {2, Unit::metres}, 0.01);
  EXPECT_EQ(e.pairs, 3u);  // rows 0-2, 1-3, 2-4
  EXPECT_NEAR(e.translation.mean, 0.1, 1e-12);
  EXPECT_NEAR(e.translation.max, 0.3, 1e-12);
}

TEST(RelativePoseError, EndsAtTheNearestPoseWithinTenPercent) {
  const files::Trajectory poses{{0, {0, 0, 0}}, {0.95, {1, 0, 0}}, {1.08, {2, 0, 0}}, {3, {3, 0, 0}}};
  files::Trajectory estimate = poses;
  estimate[1].pose.y = 0.1;
  estimate[2].pose.y = 0.7;
  const RpeErrors e = relativePoseError(estimate, poses, {1, Unit::seconds}, 0.01);
  EXPECT_EQ(e.pairs, 1u);  // 0 to 0.95; from 0.95 the nearest is 1.08, from 1.08 it is 3
  EXPECT_NEAR(e.translation.max, 0.1, 1e-12);
}

TEST(RelativePoseError, NoStretchOfThatLength) {
  using testing::HasSubstr;
  const files::Trajectory reference = straight(11);
  const auto errorOf = [&](const files::Trajectory& estimate, RpeDelta delta) {
    return test::errorOf([&] { relativePoseError(estimate, reference, delta, 0.01); });
  };
  EXPECT_EQ(
      errorOf(reference, {2, Unit::metres}),
      "no pose pairs 2 m apart: trajectory 0.000..1.000 s, reference 0.000..1.000 s; expected two poses this "
      "far apart, within 10 %");
  EXPECT_THAT(errorOf(reference, {5, Unit::seconds}), HasSubstr("no pose pairs 5 s apart"));
  EXPECT_THAT(errorOf({{0, {}}}, {1, Unit::seconds}), HasSubstr("no pose pairs 1 s apart"));
  EXPECT_THAT(errorOf({{7, {}}}, {1, Unit::seconds}), HasSubstr("does not overlap"));
}

}  // namespace
}  // namespace hybrid_slam::evaluation
