#include "slam/lines/LineDatabase.h"

#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>

#include "base/Errors.h"
#include "testing/TestLines.h"

namespace hybrid_slam {
namespace {

using namespace test;

DatabaseLine known(const LineSegment& segment, int count) { return {segment, count, 0}; }

LineSegment segment(double x1, double y1, double x2, double y2) {
  return makeSegment(TPoint2D(x1, y1), TPoint2D(x2, y2));
}

/// eq. (7) and (8) as printed, in the representation of the old line.
struct Printed {
  double rho, theta;
};
Printed printed(const DatabaseLine& line, const LineSegment& seen) {
  const double sign = std::cos(seen.theta - line.theta) < 0 ? -1 : 1;
  const double theta = line.theta + std::remainder(seen.theta - line.theta, M_PI);
  return {(line.count * line.rho + sign * seen.rho) / (line.count + 1),
          (line.count * line.theta + theta) / (line.count + 1)};
}

TEST(Merged, ParallelLinesByHand) {
  const DatabaseLine line = merged(known(segment(0, 2, 4, 2), 3), segment(2, 2.4, 7, 2.4));
  EXPECT_EQ(line.count, 4);
  EXPECT_NEAR(line.rho, (3 * 2 + 2.4) / 4, 1e-12);  // eq. (7)
  EXPECT_NEAR(line.theta, M_PI / 2, 1e-12);         // eq. (8)
  EXPECT_NEAR(std::min(line.start.x, line.end.x), 0, 1e-12);
  EXPECT_NEAR(std::max(line.start.x, line.end.x), 7, 1e-12);
  EXPECT_NEAR(line.start.y, 2.1, 1e-12);
  EXPECT_NEAR(line.end.y, 2.1, 1e-12);
  EXPECT_NEAR(line.length, 7, 1e-12);
}

TEST(Merged, EndsAreTheTwoFarthestOfTheFour) {
  for (const auto& [from, to, low, high] :
       {std::array<double, 4>{1, 2, 0, 5}, {-3, 9, -3, 9}, {-3, 2, -3, 5}}) {
    const DatabaseLine line = merged(known(segment(0, 1, 5, 1), 1), segment(to, 1, from, 1));
    EXPECT_NEAR(std::min(line.start.x, line.end.x), low, 1e-12);
    EXPECT_NEAR(std::max(line.start.x, line.end.x), high, 1e-12);
  }
}

TEST(Merged, IsThePrintedFormWithoutALeverArm) {
  RandomStream random(1, 0, 0);
  for (int i = 0; i < 1000; ++i) {
    // Both midpoints are at the foot of the perpendicular from the origin, or the lines are parallel.
    const double theta = test::uniform(random, -M_PI, M_PI), turn = test::uniform(random, -0.08, 0.08);
    const auto through = [](double direction) {
      return segment(-3 * std::sin(direction), 3 * std::cos(direction), 3 * std::sin(direction),
                     -3 * std::cos(direction));
    };
    const LineSegment base = test::randomSegment(random, 20);
    const LineSegment parallel =
        transformed(base, {0.1 * std::cos(base.theta), 0.1 * std::sin(base.theta), 0});
    const int count = 1 + static_cast<int>(9 * random.uniform());
    for (const auto& [line, seen] :
         {std::pair{known(through(theta), count), through(theta + turn)}, {known(base, count), parallel}}) {
      const DatabaseLine result = merged(line, seen);
      const Printed expected = printed(line, seen);
      EXPECT_NEAR(test::lineDistance(result.rho, result.theta, expected.rho, expected.theta), 0, 1e-9);
    }
  }
}

TEST(Merged, ThetaIsAlwaysThatOfEquation8) {
  RandomStream random(2, 0, 0);
  for (int i = 0; i < 1000; ++i) {
    const LineSegment base = test::randomSegment(random, 20);
    const TPoint2D m = middle(base);
    const double turn = test::uniform(random, -0.08, 0.08);
    // Rotated about its own midpoint.
    const TPose2D frame(m.x - m.x * std::cos(turn) + m.y * std::sin(turn),
                        m.y - m.x * std::sin(turn) - m.y * std::cos(turn), turn);
    const DatabaseLine line = merged(known(base, 4), transformed(base, frame));
    EXPECT_NEAR(test::angleBetween(line.theta, printed(known(base, 4), transformed(base, frame)).theta), 0,
                1e-12);
    EXPECT_NEAR(signedDistance(m, line.rho, line.theta), 0, 1e-9);  // and it still goes through the middle
  }
}

/// The figure of doc/paper-notes.md: what eq. (7) as printed does to two observations of a wall that differ
/// by 5 deg and have the same midpoint, 50 m from the map's origin.
TEST(Merged, PrintedFormDriftsTowardsTheOrigin) {
  const double half = 2.5 * kDegree;
  const LineSegment a =
      segment(50 - 3 * std::sin(half), -3 * std::cos(half), 50 + 3 * std::sin(half), 3 * std::cos(half));
  const LineSegment b =
      segment(50 + 3 * std::sin(half), -3 * std::cos(half), 50 - 3 * std::sin(half), 3 * std::cos(half));
  const Printed asPrinted = printed(known(a, 1), b);
  EXPECT_NEAR(50 - asPrinted.rho, 50 * (1 - std::cos(half)), 1e-9);  // 4.8 cm
  EXPECT_NEAR(merged(known(a, 1), b).rho, 50, 1e-9);
}

TEST(Merged, MergingTheSameLineChangesNothing) {
  RandomStream random(3, 0, 0);
  for (int i = 0; i < 300; ++i) {
    const LineSegment original = test::randomSegment(random, 50);
    LineSegment reversed = original;
    std::swap(reversed.start, reversed.end);
    DatabaseLine line = known(original, 1);
    for (int k = 0; k < 50; ++k) line = merged(line, k % 2 ? original : reversed);
    EXPECT_EQ(line.count, 51);
    EXPECT_NEAR(test::lineDistance(line.rho, line.theta, original.rho, original.theta), 0, 1e-9);
    EXPECT_NEAR(line.length, original.length, 1e-9);
    const bool same = std::hypot(line.start.x - original.start.x, line.start.y - original.start.y) < 1e-9;
    EXPECT_NEAR(same ? line.end.x : line.start.x, original.end.x, 1e-9);
  }
}

TEST(Merged, DoesNotDependOnTheFrame) {
  RandomStream random(4, 0, 0);
  for (int i = 0; i < 1000; ++i) {
    const LineSegment base = test::randomSegment(random, 10);
    const auto near = [&random](const TPoint2D& p) {
      return TPoint2D(p.x + test::uniform(random, -0.2, 0.2), p.y + test::uniform(random, -0.2, 0.2));
    };
    const LineSegment seen = makeSegment(near(base.start), near(base.end));
    const TPose2D frame = test::randomPose(random, 100);
    const LineSegment here = transformed(merged(known(base, 3), seen), frame);
    const DatabaseLine there = merged(known(transformed(base, frame), 3), transformed(seen, frame));
    EXPECT_NEAR(test::lineDistance(here.rho, here.theta, there.rho, there.theta), 0, 1e-9);
    EXPECT_NEAR(here.length, there.length, 1e-9);
  }
}

TEST(Merged, AcrossTheWrapAndAcrossZero) {
  const DatabaseLine wrap = merged(known(makeSegment(4, M_PI - 0.01, TPoint2D(-4, -2), TPoint2D(-4, 2)), 1),
                                   makeSegment(4, -M_PI + 0.01, TPoint2D(-4, -2), TPoint2D(-4, 2)));
  EXPECT_NEAR(test::angleBetween(wrap.theta, M_PI), 0, 1e-12);
  EXPECT_NEAR(wrap.rho, 4, 1e-3);
  EXPECT_GT(std::cos(wrap.theta - M_PI), 0.99);

  const DatabaseLine zero = merged(known(segment(-3, 0.02, 3, 0.02), 1), segment(-3, -0.04, 3, -0.04));
  EXPECT_NEAR(zero.rho, 0.01, 1e-12);
  EXPECT_NEAR(zero.theta, -M_PI / 2, 1e-12);
}

class Database : public testing::Test {
 protected:
  void update(const std::vector<LineSegment>& seen) { database.update(seen, options, association); }

  LineDatabase database;
  LineDatabaseOptions options;
  AssociationOptions association;
  const LineSegment wall = segment(0, 2, 6, 2), side = segment(8, 0, 8, 7);
};

TEST_F(Database, InsertsOnlyUnmatchedLinesThatAreLongEnough) {
  update({wall, side, segment(0, -4, 4.9, -4)});
  ASSERT_EQ(database.lines().size(), 2u);
  EXPECT_EQ(database.lines()[0].count, 1);
  options.minLength = 4;
  update({segment(0, -4, 4.9, -4)});
  EXPECT_EQ(database.lines().size(), 3u);
}

TEST_F(Database, AShortLineUpdatesTheLineThatItMatches) {
  update({wall});
  update({segment(2, 2.1, 3, 2.1)});
  ASSERT_EQ(database.lines().size(), 1u);
  EXPECT_EQ(database.lines()[0].count, 2);
  EXPECT_NEAR(database.lines()[0].rho, 2.05, 1e-12);
}

TEST_F(Database, TheClosestLineIsUpdated) {
  association.maxRho = 0.3;
  update({wall});
  update({segment(0, 2.4, 6, 2.4)});
  ASSERT_EQ(database.lines().size(), 2u);
  update({segment(0, 2.25, 6, 2.25)});  // within the threshold of both
  EXPECT_EQ(database.lines()[0].count, 1);
  EXPECT_EQ(database.lines()[1].count, 2);
}

TEST_F(Database, PrunesRarelySeenLinesEveryTenUpdates) {
  update({wall, side});
  for (int i = 2; i <= 3; ++i) update({wall});
  for (int i = 4; i <= 10; ++i) update({});
  EXPECT_EQ(database.lines().size(), 2u);  // at update 10 the side wall has had 9 chances
  for (int i = 11; i <= 19; ++i) update({});
  EXPECT_EQ(database.lines().size(), 2u);
  update({});
  ASSERT_EQ(database.lines().size(), 1u);
  EXPECT_EQ(database.lines()[0].count, 3);
}

TEST_F(Database, ANewLineIsKeptForOnePruneInterval) {
  for (int i = 1; i <= 9; ++i) update({});
  update({wall});  // inserted in the very update that prunes
  ASSERT_EQ(database.lines().size(), 1u);
  for (int i = 11; i <= 19; ++i) update({});
  EXPECT_EQ(database.lines().size(), 1u);
  update({});
  EXPECT_TRUE(database.lines().empty());
}

TEST_F(Database, DominatingDirection) {
  EXPECT_FALSE(database.dominatingDirection());
  update({});
  EXPECT_FALSE(database.dominatingDirection());
  update({wall, side});
  ASSERT_TRUE(database.dominatingDirection());
  EXPECT_NEAR(std::remainder(*database.dominatingDirection(), M_PI / 2), 0, 1e-12);
}

/// Closed form: for any rotation, parallel and perpendicular lines give that rotation modulo 90 deg.
TEST_F(Database, DominatingDirectionTurnsWithTheBuilding) {
  RandomStream random(5, 0, 0);
  for (int i = 0; i < 300; ++i) {
    const double turn = test::uniform(random, -M_PI, M_PI);
    LineDatabase turned;
    turned.update({transformed(wall, {3, 4, turn}), transformed(side, {3, 4, turn})}, options, association);
    ASSERT_TRUE(turned.dominatingDirection());
    EXPECT_NEAR(std::remainder(*turned.dominatingDirection() - turn, M_PI / 2), 0, 1e-12);
    EXPECT_LE(std::abs(*turned.dominatingDirection()), M_PI / 4 + 1e-12);
  }
}

/// Calculated by hand: weights 6 m x 1 and 10 m x min(count, 20); the cap is reached at the 20th sighting.
TEST_F(Database, DominatingDirectionWeighsByLengthAndCappedCount) {
  const LineSegment tilted = transformed(segment(-5, 0, 5, 0), {0, -9, 0.1});
  for (int count = 1; count <= 25; ++count) {
    update(count == 1 ? std::vector<LineSegment>{wall, tilted} : std::vector<LineSegment>{tilted});
    options.pruneInterval = 1000;
    const double w = 10 * std::min(count, 20);
    ASSERT_TRUE(database.dominatingDirection());
    EXPECT_NEAR(*database.dominatingDirection(), std::atan2(w * std::sin(0.4), 6 + w * std::cos(0.4)) / 4,
                1e-9);
  }
}

TEST_F(Database, LinesThatCancelHaveNoDominatingDirection) {
  update({segment(0, 3, 6, 3), transformed(segment(-3, 0, 3, 0), {20, 0, M_PI / 4})});
  ASSERT_EQ(database.lines().size(), 2u);
  EXPECT_FALSE(database.dominatingDirection());
}

/// Calculated by hand: evidence 6 and 12, 0.3 deg apart, window 0.5 deg: the kernel is 1 - 0.36 = 0.64.
TEST_F(Database, ManyObservationsOfARoomConvergeToItsWalls) {
  RandomStream random(6, 0, 0);
  const std::vector<LineSegment> walls{segment(40, 30, 48, 30), segment(48, 30, 48, 36),
                                       segment(48, 36, 40, 36), segment(40, 36, 40, 30)};
  for (int i = 0; i < 200; ++i) {
    std::vector<LineSegment> seen;
    for (const LineSegment& w : walls) {
      const TPoint2D m = middle(w);
      const double turn = 0.5 * kDegree * random.gaussian();  // a heading error, about the robot inside
      seen.push_back(transformed(transformed(w, {-44, -33, 0}),
                                 {44 + 0.02 * random.gaussian(), 33 + 0.02 * random.gaussian(), turn}));
      EXPECT_GT(m.x, 0);
    }
    update(seen);
  }
  ASSERT_EQ(database.lines().size(), 4u);
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(database.lines()[i].count, 200);
    EXPECT_NEAR(test::angleBetween(database.lines()[i].theta, walls[i].theta), 0, 0.15 * kDegree);
    EXPECT_NEAR(signedDistance(middle(walls[i]), database.lines()[i].rho, database.lines()[i].theta), 0,
                0.01);
  }
}

TEST(LineDatabaseOptions, RangesAreChecked) {
  for (const char* line : {"min_length = -1", "min_count = 0", "prune_interval = 0", "prune_interval = 2.5",
                           "direction_window_deg = 23"}) {
    LineDatabaseOptions options;
    const mrpt::config::CConfigFileMemory file(std::string("[line_database]\n") + line + "\n");
    EXPECT_THROW(options.loadFromConfigFile(file, "line_database"), InputError) << line;
  }
}

}  // namespace
}  // namespace hybrid_slam
