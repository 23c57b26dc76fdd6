#include "study/evaluation/RevisitError.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>

#include <cmath>
#include <limits>

#include "base/Errors.h"
#include "base/RandomStream.h"

namespace hybrid_slam::evaluation {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr double kForever = std::numeric_limits<double>::infinity();

/// A drive: the poses of a trajectory, and the scans at the true poses.
struct Drive {
  files::Trajectory trajectory;
  std::vector<readings::EndPoints> scans;

  void add(const TPose2D& claimed, const std::vector<TPoint2D>& seen) {
    const double time = static_cast<double>(scans.size());
    trajectory.push_back({time, claimed});
    scans.push_back({time, seen});
  }
  RevisitErrors errors(const RevisitOptions& options = {}) const {
    return revisitErrors(trajectory, scans, options);
  }
};

/// Scan of a 360 deg laser with 360 beams, up to `maxRange`, of walls at x = +-halfLength and y =
/// +-halfWidth.
std::vector<TPoint2D> look(const TPose2D& robot, double halfLength, double halfWidth, double maxRange) {
  std::vector<TPoint2D> points;
  for (int degree = -180; degree < 180; ++degree) {
    const double angle = mrpt::DEG2RAD(degree);
    const double c = std::cos(robot.phi + angle), s = std::sin(robot.phi + angle);
    const double range =
        std::min((std::copysign(halfLength, c) - robot.x) / c, (std::copysign(halfWidth, s) - robot.y) / s);
    if (range < maxRange) points.emplace_back(range * std::cos(angle), range * std::sin(angle));
  }
  return points;
}

/// Two laps in a square room of 12 m, on a circle of 4 m radius. On the second lap, which begins after 25.1
/// m, the trajectory is shifted by `shift` in x.
Drive twoLaps(double shift) {
  Drive drive;
  constexpr double kStep = 0.21;  // m; the laps' scans are not taken at the same places
  for (int i = 0; i * kStep < 16 * M_PI; ++i) {
    const double way = i * kStep, angle = way / 4;
    const TPose2D pose{4 * std::cos(angle), 4 * std::sin(angle), angle + M_PI / 2};
    const double aside = way < 8 * M_PI ? 0 : shift;
    drive.add({pose.x + aside, pose.y, pose.phi}, look(pose, 6, 6, kForever));
  }
  return drive;
}

/// A drive of `length` m along a corridor 3 m wide and back, with a scan every 0.21 m. On the way back, the
/// trajectory is shifted sideways by `shift`.
Drive outAndBack(double length, double shift) {
  Drive drive;
  for (int i = 0; i * 0.21 <= 2 * length; ++i) {
    const double way = i * 0.21;
    const TPose2D pose = way <= length ? TPose2D(way, 0, 0) : TPose2D(2 * length - way, 0, M_PI);
    drive.add({pose.x, way <= length ? 0 : shift, pose.phi}, look(pose, kForever, 1.5, 4));
  }
  return drive;
}

TEST(RevisitError, ExactPosesCloseTheRoom) {
  const RevisitErrors e = twoLaps(0).errors();
  EXPECT_EQ(e.scans, 240u);
  EXPECT_GT(e.revisits, 110u);  // the second lap, but also the end of the first, where the start is near
  EXPECT_EQ(e.apart, 0u);
  EXPECT_LT(e.error.max, 1e-9);
}

TEST(RevisitError, AShiftIsSeenOnlyOnTheWallsAcrossIt) {
  const RevisitErrors e = twoLaps(0.15).errors();
  EXPECT_EQ(e.apart, 0u);
  EXPECT_GT(e.error.mean, 0.02);
  EXPECT_LT(e.error.mean, 0.13);
  EXPECT_NEAR(e.error.max, 0.15, 0.001);  // scans that see more of the walls across
  EXPECT_NEAR(e.p95, 0.15, 0.001);
}

TEST(RevisitError, ShiftOfACorridorIsTheError) {
  for (const double shift : {0.0, 0.05, 0.15, 0.3}) {
    SCOPED_TRACE(shift);
    const RevisitErrors e = outAndBack(14, shift).errors();
    EXPECT_GT(e.revisits, 20u);
    EXPECT_EQ(e.apart, 0u);
    for (const double figure : {e.error.median, e.error.mean, e.error.max, e.p95})
      EXPECT_NEAR(figure, shift, 1e-9);
  }
}

TEST(RevisitError, WallsThatDoNotMeetAreApart) {
  const RevisitErrors e = outAndBack(14, 1).errors();
  EXPECT_GT(e.revisits, 20u);
  EXPECT_EQ(e.apart, e.revisits);
  EXPECT_EQ(e.error.median, 0.5);
  EXPECT_EQ(e.error.max, 0.5);
}

TEST(RevisitError, RevisitsNeedDistanceDrivenAndProximity) {
  const RevisitErrors none = outAndBack(9.9, 0).errors();
  EXPECT_EQ(none.scans, 95u);
  EXPECT_EQ(none.revisits, 0u);
  EXPECT_EQ(none.apart, 0u);
  EXPECT_EQ(none.error.max, 0);
  EXPECT_GT(outAndBack(9.9, 0).errors({3, 10}).revisits, 20u);
  EXPECT_EQ(outAndBack(14, 0.15).errors({0.14, 20}).revisits, 0u);
  EXPECT_GT(outAndBack(14, 0.15).errors({0.3, 20}).revisits, 5u);
}

TEST(RevisitError, RigidMotionOfTheTrajectoryChangesNothing) {
  RandomStream random(1, 0, 0);
  for (int trial = 0; trial < 5; ++trial) {
    Drive drive = outAndBack(14, 0.1);
    for (files::StampedPose& p : drive.trajectory) p.pose.y += 0.05 * random.gaussian();
    const RevisitErrors a = drive.errors({2.95, 19.95});
    const TPose2D motion{20 * random.gaussian(), 20 * random.gaussian(), M_PI * random.uniform()};
    for (files::StampedPose& p : drive.trajectory) p.pose = motion + p.pose;
    const RevisitErrors b = drive.errors({2.95, 19.95});
    EXPECT_GT(a.error.median, 0.01);
    EXPECT_EQ(a.revisits, b.revisits);
    EXPECT_EQ(a.apart, b.apart);
    EXPECT_NEAR(a.error.median, b.error.median, 1e-9);
    EXPECT_NEAR(a.error.mean, b.error.mean, 1e-9);
    EXPECT_NEAR(a.p95, b.p95, 1e-9);
    EXPECT_NEAR(a.error.max, b.error.max, 1e-9);
  }
}

/// The scan `first` at the origin, then an empty scan 20 m away, then each scan of `again` at the origin.
RevisitErrors seenAgain(const std::vector<TPoint2D>& first, const std::vector<std::vector<TPoint2D>>& again) {
  Drive drive;
  drive.add({0, 0, 0}, first);
  drive.add({10, 0, 0}, {});
  for (const auto& points : again) drive.add({0, 0, 0}, points);
  return drive.errors();
}

TEST(RevisitError, DistanceIsToTheWallBetweenBeamsNearEachOther) {
  const std::vector<TPoint2D> gapOf02{{0, 1}, {0.2, 1}}, gapOf04{{0, 1}, {0.4, 1}};
  EXPECT_NEAR(seenAgain(gapOf02, {{{0.05, 1.03}}}).error.max, 0.03, 1e-12);   // to the next beam's point
  EXPECT_NEAR(seenAgain(gapOf02, {{{0.15, 1.03}}}).error.max, 0.03, 1e-12);   // to the previous beam's point
  EXPECT_NEAR(seenAgain(gapOf02, {{{-0.04, 1.03}}}).error.max, 0.05, 1e-12);  // beyond the wall's end
  EXPECT_NEAR(seenAgain(gapOf04, {{{0.04, 1.03}}}).error.max, 0.05, 1e-12);
}

TEST(RevisitError, ScansThatAreNotNearEachOtherMakeNoWall) {
  for (const double x : {0.04, 0.16}) {  // the nearest point is the first scan's, the second's
    Drive drive;
    drive.add({0, 0, 0}, {{0, 1}});
    drive.add({0, 0, 0}, {{0.2, 1}});
    drive.add({10, 0, 0}, {});
    drive.add({0, 0, 0}, {{x, 1.03}});
    EXPECT_NEAR(drive.errors().error.max, 0.05, 1e-12);
  }
}

TEST(RevisitError, ThirtyPercentOfTheBeamsAreEnough) {
  std::vector<TPoint2D> points(10, {5, 5});
  points[0] = points[1] = {0, 1.1};
  const RevisitErrors few = seenAgain({{0, 1}}, {points});
  EXPECT_EQ(few.apart, 1u);
  EXPECT_EQ(few.error.max, 0.5);
  points[2] = {0, 1.49};
  const RevisitErrors enough = seenAgain({{0, 1}}, {points});
  EXPECT_EQ(enough.apart, 0u);
  EXPECT_NEAR(enough.error.max, 0.1, 1e-12);  // the middle of 0.1, 0.1, 0.49
  points[2] = {0, 1.51};
  EXPECT_EQ(seenAgain({{0, 1}}, {points}).apart, 1u);
}

TEST(RevisitError, FiguresOfSeveralRevisits) {
  std::vector<std::vector<TPoint2D>> again;
  for (int i = 20; i >= 1; --i) again.push_back({{0, 1 + 0.01 * i}});
  again.push_back({});  // no end points: no revisit
  const RevisitErrors e = seenAgain({{0, 1}}, again);
  EXPECT_EQ(e.scans, 23u);
  EXPECT_EQ(e.revisits, 20u);
  EXPECT_NEAR(e.error.median, 0.11, 1e-12);
  EXPECT_NEAR(e.error.mean, 0.105, 1e-12);
  EXPECT_NEAR(e.p95, 0.19, 1e-12);
  EXPECT_NEAR(e.error.max, 0.20, 1e-12);
}

TEST(RevisitError, ScansWithoutAPoseAreLeftOut) {
  Drive drive = outAndBack(14, 0.15);
  const RevisitErrors whole = drive.errors();
  drive.scans.push_back({1000, {{0, 0.1}}});
  drive.scans.push_back({drive.trajectory.back().timestamp + 0.0011, {{0, 0.1}}});
  const RevisitErrors e = drive.errors();
  EXPECT_EQ(e.scans, whole.scans);
  EXPECT_EQ(e.revisits, whole.revisits);
  drive.scans.push_back({drive.trajectory.back().timestamp + 0.0009, {{0, 0.1}}});
  EXPECT_EQ(drive.errors().scans, whole.scans + 1);
}

TEST(RevisitError, NeedsAScanWithAPose) {
  const auto errorOf = [](const files::Trajectory& trajectory,
                          const std::vector<readings::EndPoints>& scans) -> std::string {
    try {
      revisitErrors(trajectory, scans, {});
    } catch (const InputError& e) {
      return e.what();
    }
    return "no error";
  };
  EXPECT_EQ(errorOf({{1, {}}, {2, {}}}, {{5, {}}, {6.5, {}}}),
            "no scan has a pose: trajectory 1.000..2.000 s, scans 5.000..6.500 s; expected poses within "
            "0.001 s of the scans");
  EXPECT_THAT(errorOf({{1, {}}}, {}), testing::HasSubstr("scans none"));
  EXPECT_EQ(errorOf({{1, {}}}, {{1, {}}}), "no error");  // and no beams
}

}  // namespace
}  // namespace hybrid_slam::evaluation
