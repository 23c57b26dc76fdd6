#include "slam/lines/LineSegment.h"

#include <gtest/gtest.h>

#include "base/RandomStream.h"
#include "testing/TestLines.h"

namespace hybrid_slam {
namespace {

using namespace test;

void expectConsistent(const LineSegment& s, double tolerance) {
  EXPECT_GE(s.rho, 0);
  EXPECT_GT(s.theta, -M_PI);
  EXPECT_LE(s.theta, M_PI);
  EXPECT_NEAR(signedDistance(s.start, s.rho, s.theta), 0, tolerance);
  EXPECT_NEAR(signedDistance(s.end, s.rho, s.theta), 0, tolerance);
  EXPECT_NEAR(s.length, std::hypot(s.end.x - s.start.x, s.end.y - s.start.y), tolerance);
}

TEST(LineSegment, HesseNormalFormOfKnownLines) {
  struct Case {
    TPoint2D start, end;
    double rho, theta, length;
  };
  for (const Case& c : {Case{{2, -1}, {2, 3}, 2, 0, 4}, Case{{-1, 5}, {2, 5}, 5, M_PI / 2, 3},
                        Case{{-2, -1}, {-2, 1}, 2, M_PI, 2}, Case{{0, -3}, {1, -3}, 3, -M_PI / 2, 1},
                        Case{{2, 0}, {0, 2}, std::sqrt(2.0), M_PI / 4, std::sqrt(8.0)}})
    for (const bool swapped : {false, true}) {
      const LineSegment s = swapped ? makeSegment(c.end, c.start) : makeSegment(c.start, c.end);
      EXPECT_NEAR(s.rho, c.rho, 1e-12);
      EXPECT_NEAR(s.theta, c.theta, 1e-12);
      EXPECT_NEAR(s.length, c.length, 1e-12);
      expectConsistent(s, 1e-12);
    }
}

TEST(LineSegment, HalfTurnDifferenceIsTheRemainder) {
  RandomStream random(1, 0, 0);
  for (int i = 0; i < 10000; ++i) {
    const double a = 10 * random.uniform() - 5, b = 10 * random.uniform() - 5;
    EXPECT_EQ(halfTurnDifference(a, b), std::remainder(a - b, M_PI)) << a << " - " << b;
  }
}

TEST(LineSegment, ThroughTheOriginEitherNormalDescribesTheLine) {
  const LineSegment s = makeSegment(TPoint2D(-1, -1), TPoint2D(2, 2));
  EXPECT_NEAR(s.rho, 0, 1e-12);
  EXPECT_NEAR(test::angleBetween(s.theta, 3 * M_PI / 4), 0, 1e-12);
}

TEST(LineSegment, TwoEqualEndsAreParallelToTheXAxis) {
  const LineSegment s = makeSegment(TPoint2D(3, 4), TPoint2D(3, 4));
  EXPECT_EQ(s.length, 0);
  EXPECT_NEAR(s.theta, M_PI / 2, 1e-12);
  EXPECT_NEAR(s.rho, 4, 1e-12);
}

TEST(LineSegment, NormaliseKeepsTheLine) {
  RandomStream random(1, 0, 0);
  for (int i = 0; i < 1000; ++i) {
    const double rho = test::uniform(random, -5, 5), theta = test::uniform(random, -20, 20);
    double r = rho, t = theta;
    normalise(r, t);
    EXPECT_GE(r, 0);
    EXPECT_GT(t, -M_PI);
    EXPECT_LE(t, M_PI);
    EXPECT_NEAR(test::lineDistance(r, t, rho, theta), 0, 1e-12);
  }
  double rho = 1, theta = -M_PI;
  normalise(rho, theta);
  EXPECT_EQ(theta, M_PI);
}

TEST(LineSegment, EndsAreProjectedOnTheGivenLine) {
  const LineSegment s = makeSegment(-2, M_PI / 2, TPoint2D(1, 7), TPoint2D(4, -3));  // y = -2
  EXPECT_NEAR(s.rho, 2, 1e-12);
  EXPECT_NEAR(s.theta, -M_PI / 2, 1e-12);
  EXPECT_NEAR(s.start.x, 1, 1e-12);
  EXPECT_NEAR(s.start.y, -2, 1e-12);
  EXPECT_NEAR(s.end.x, 4, 1e-12);
  EXPECT_NEAR(s.length, 3, 1e-12);
}

TEST(LineSegment, TransformByHand) {
  // x = 1 seen from a robot at (2, 3) that looks along y: the map's line y = 4.
  const LineSegment s = transformed(makeSegment(TPoint2D(1, -1), TPoint2D(1, 1)), {2, 3, M_PI / 2});
  EXPECT_NEAR(s.rho, 4, 1e-12);
  EXPECT_NEAR(s.theta, M_PI / 2, 1e-12);
  EXPECT_NEAR(s.start.x, 3, 1e-12);
  EXPECT_NEAR(s.end.x, 1, 1e-12);
}

TEST(LineSegment, TransformRoundTrip) {
  RandomStream random(2, 0, 0);
  for (int i = 0; i < 1000; ++i) {
    const LineSegment s = test::randomSegment(random, 30);
    const TPose2D frame = test::randomPose(random, 50);
    const LineSegment there = transformed(s, frame);
    expectConsistent(there, 1e-9);
    const TPoint2D back = frame.inverseComposePoint(TPoint2D(0, 0));
    const LineSegment again = transformed(there, {back.x, back.y, -frame.phi});
    EXPECT_NEAR(test::lineDistance(again.rho, again.theta, s.rho, s.theta), 0, 1e-9);
    EXPECT_NEAR(again.start.x, s.start.x, 1e-9);
    EXPECT_NEAR(again.end.y, s.end.y, 1e-9);
    EXPECT_EQ(again.length, s.length);
  }
}

TEST(LineSegment, SensorToRobotToMapIsOneTransform) {
  RandomStream random(3, 0, 0);
  for (int i = 0; i < 1000; ++i) {
    const LineSegment s = test::randomSegment(random, 10);
    const TPose2D sensor = test::randomPose(random, 1), robot = test::randomPose(random, 50);
    const LineSegment steps = transformed(transformed(s, sensor), robot);
    const LineSegment once = transformed(s, robot + sensor);
    EXPECT_NEAR(test::lineDistance(steps.rho, steps.theta, once.rho, once.theta), 0, 1e-9);
    EXPECT_NEAR(steps.start.x, once.start.x, 1e-9);
    EXPECT_NEAR(steps.end.y, once.end.y, 1e-9);
  }
}

}  // namespace
}  // namespace hybrid_slam
