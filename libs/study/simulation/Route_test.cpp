#include "study/simulation/Route.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/Degree.h"
#include "base/Errors.h"
#include "study/simulation/BuildingPlan.h"
#include "testing/ErrorOf.h"
#include "testing/TemporaryFile.h"

namespace hybrid_slam::simulation {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Route routeOf(const std::string& text) { return Route::load(test::TemporaryFile(text).path()); }

std::string routeError(const std::string& text) {
  return test::errorOf([&] { routeOf(text); });
}

void expectPose(const mrpt::math::TPose2D& pose, double x, double y, double degrees) {
  EXPECT_NEAR(pose.x, x, 1e-9);
  EXPECT_NEAR(pose.y, y, 1e-9);
  EXPECT_NEAR(std::remainder(pose.phi - degrees * kDegree, 2 * M_PI), 0, 1e-9);
}

TEST(Route, TurnsOnTheSpotAndDrivesStraight) {
  const Route route = routeOf("start 1 2 0\nspeed 0.5\nturn_speed 45\ngo 1 4\nwait 3\nturn 180\n");
  EXPECT_NEAR(route.duration(), 2 + 4 + 3 + 2, 1e-9);
  expectPose(route.poseAt(-1), 1, 2, 0);
  expectPose(route.poseAt(0), 1, 2, 0);
  expectPose(route.poseAt(1), 1, 2, 45);
  expectPose(route.poseAt(2), 1, 2, 90);
  expectPose(route.poseAt(4), 1, 3, 90);
  expectPose(route.poseAt(8), 1, 4, 90);
  expectPose(route.poseAt(10), 1, 4, 135);
  expectPose(route.poseAt(99), 1, 4, 180);
}

TEST(Route, ASmoothTurnRoundsTheCornerOnItsRadius) {
  const Route route = routeOf("start 0 0 0\nspeed 0.5\nturn_speed 90\nvia 4 0 1\ngo 4 3\n");
  const double arc = M_PI / 2;  // m
  EXPECT_NEAR(route.duration(), (3 + arc + 2) / 0.5, 1e-9);
  expectPose(route.poseAt(6), 3, 0, 0);
  expectPose(route.poseAt(6 + arc), 3 + std::sqrt(0.5), 1 - std::sqrt(0.5), 45);
  expectPose(route.poseAt(6 + 2 * arc), 4, 1, 90);
  EXPECT_NEAR(route.progressAt(route.duration()).distance, 3 + arc + 2, 1e-9);
  EXPECT_NEAR(route.progressAt(route.duration()).rotation, M_PI / 2, 1e-9);
}

TEST(Route, ATightCurveIsDrivenAtTheTurnSpeed) {
  const Route route = routeOf("start 0 0 0\nspeed 1\nturn_speed 30\nvia 4 0 0.5\ngo 4 -3\n");
  const auto& curve = route.pieces().at(1);
  EXPECT_NEAR(curve.omega, -30 * kDegree, 1e-12);
  EXPECT_NEAR(curve.v, 0.5 * 30 * kDegree, 1e-12);
  EXPECT_NEAR(curve.duration, 3, 1e-9);
}

TEST(Route, PiecesFollowEachOtherWithoutJumps) {
  const Route route = routeOf(
      "start 0 0 90\nvia 5 1 0.7\nvia 6 5 1.5\nvia 2 9 1\ngo -3 3\nturn 10\nspeed 1\nvia -8 2 2\ngo -9 -6\n");
  double time = 0;
  for (size_t i = 0; i + 1 < route.pieces().size(); ++i) {
    const auto& piece = route.pieces()[i];
    EXPECT_NEAR(piece.startTime, time, 1e-9);
    time += piece.duration;
    const auto end = piece.poseAfter(piece.duration), next = route.pieces()[i + 1].start;
    expectPose(end, next.x, next.y, next.phi / kDegree);
  }
  expectPose(route.poseAt(1e9), -9, -6, std::atan2(-8, -1) / kDegree);
}

TEST(Route, TurnsTakeTheShorterWay) {
  const Route route = routeOf("start 0 0 170\nturn_speed 10\nturn -170\n");
  EXPECT_NEAR(route.duration(), 2, 1e-9);
  EXPECT_NEAR(route.progressAt(2).rotation, 20 * kDegree, 1e-9);
}

TEST(Route, ErrorsNameTheLine) {
  EXPECT_THAT(routeError("start 0 0 0\ngoo 1 0\n"),
              AllOf(HasSubstr("unknown word `goo`"), HasSubstr(", line 2; ")));
  EXPECT_THAT(routeError("go 1 0\n"), HasSubstr("`go` before `start`"));
  EXPECT_THAT(routeError("start 0 0 0\nstart 1 0 0\n"), HasSubstr("second `start`"));
  EXPECT_THAT(routeError("start 0 0 0\ngo 1\n"), HasSubstr("expected `go X Y`"));
  EXPECT_THAT(routeError("start 0 0 0\nspeed 0\ngo 1 0\n"), HasSubstr("`speed` too low"));
  EXPECT_THAT(routeError("start 0 0 0\nspeed 1e-300\ngo 1 0\n"), HasSubstr("expected at least 0.001 m/s"));
  EXPECT_THAT(routeError("start 0 0 0\nturn_speed -1\ngo 1 0\n"), HasSubstr("`turn_speed` too low"));
  EXPECT_THAT(routeError("start 0 0 0\nwait -1\n"), HasSubstr("`wait` too low"));
  EXPECT_THAT(routeError("start 0 0 0\nvia 1 0 0\ngo 1 1\n"), HasSubstr("`via` too low"));
  EXPECT_THAT(routeError("start 0 0 0\ngo 1 0\ngo 1 0\n"), HasSubstr("repeated way point"));
  EXPECT_THAT(routeError("start 0 0 0\nvia 1 0 2\ngo 1 5\n"), HasSubstr("does not fit"));
  EXPECT_THAT(routeError("start 0 0 0\nvia 5 0 2\ngo 5 1\n"), HasSubstr("does not fit"));
  EXPECT_THAT(routeError("start 0 0 0\nvia 5 0 2\ngo 0 0\n"), HasSubstr("does not fit"));
  EXPECT_THAT(routeError("start 0 0 0\nvia 5 0 2\n"), HasSubstr("route ends with `via`"));
  EXPECT_THAT(routeError("start 0 0 0\nvia 5 0 2\nwait 1\n"), HasSubstr("`via` followed by `wait`"));
  EXPECT_THAT(routeError("start 0 0 0\n"), HasSubstr("route without way points"));
}

std::string clearanceError(const std::string& text, double radius) {
  const BuildingPlan room(
      {Wall::straight({0, 0}, {10, 0}), Wall::straight({5, 1}, {5, 4}), Wall::straight({0, 4}, {10, 4})});
  try {
    routeOf(text).checkClear(room, radius);
  } catch (const InputError& e) {
    return e.what();
  }
  return "clear";
}

TEST(Route, WayPointsAndPathKeepTheRobotsRadiusFromAllWalls) {
  EXPECT_EQ(clearanceError("start 2 0.5 0\ngo 8 0.5\n", 0.4), "clear");
  EXPECT_THAT(clearanceError("start 2 0.5 0\ngo 8 0.5\n", 0.55),
              HasSubstr("way point inside a wall at (2.00, 0.50)"));
  EXPECT_THAT(clearanceError("start 2 2 0\ngo 2 0.2\n", 0.3),
              AllOf(HasSubstr("way point inside a wall at (2.00, 0.20)"), HasSubstr(", line 2; "),
                    HasSubstr("0.3 m")));
  EXPECT_THAT(clearanceError("start 2 2 0\ngo 8 2\n", 0.3),
              AllOf(HasSubstr("path hits a wall at (4.7"), HasSubstr(", line 2; ")));
  EXPECT_THAT(clearanceError("start 2 2 0\ngo 8 2\n", 0), HasSubstr("path crosses a wall at (5.0"));
}

}  // namespace
}  // namespace hybrid_slam::simulation
