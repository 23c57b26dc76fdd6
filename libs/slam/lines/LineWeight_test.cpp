#include "slam/lines/LineWeight.h"

#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>

#include "base/Errors.h"
#include "testing/TestLines.h"

namespace hybrid_slam {
namespace {

using namespace test;

using WeightMethod = LineWeightOptions::Method;

/// A segment of this length and normal direction (only these two count).
LineSegment line(double thetaDeg, double length) {
  return transformed(makeSegment(TPoint2D(2, 0), TPoint2D(2, length)), {0, 0, thetaDeg * kDegree});
}

LineDatabase databaseOf(const std::vector<LineSegment>& lines) {
  LineDatabaseOptions options;
  options.minLength = 0;
  LineDatabase database;
  database.update(lines, options, AssociationOptions());
  return database;
}

LineWeightOptions method(WeightMethod m) {
  LineWeightOptions options;
  options.method = m;
  return options;
}

const std::vector<WeightMethod> kMethods{WeightMethod::graded, WeightMethod::dominatingDirection,
                                         WeightMethod::paper};

TEST(LineWeight, NeutralWithoutLinesOrDatabase) {
  for (const WeightMethod m : kMethods) {
    const LineWeight empty = lineWeight({line(10, 3), line(20, 1)}, 0.3, LineDatabase(), method(m));
    EXPECT_EQ(empty.value, 1);
    EXPECT_EQ(empty.seen, 2);
    EXPECT_EQ(empty.matched, 0);
    const LineWeight blind = lineWeight({}, 0.3, databaseOf({line(0, 6)}), method(m));
    EXPECT_EQ(blind.value, 1);
    EXPECT_EQ(blind.seen, 0);
  }
}

TEST(LineWeight, NeutralForLinesWithoutLength) {
  for (const WeightMethod m : kMethods)
    EXPECT_EQ(lineWeight({line(30, 0)}, 0, databaseOf({line(0, 6)}), method(m)).value, 1);
}

/// eq. (9) by hand: 6 of 10 m parallel or perpendicular within 3 deg.
TEST(LineWeight, PaperByHand) {
  const LineDatabase database = databaseOf({line(20, 6)});
  const std::vector<LineSegment> seen{line(22.9, 1), line(110, 2), line(-72.9, 3), line(24, 2.5),
                                      line(65, 1.5)};
  auto options = method(WeightMethod::paper);
  options.threshold = 3 * kDegree;
  const LineWeight weight = lineWeight(seen, 0, database, options);
  EXPECT_NEAR(weight.value, 0.6, 1e-12);
  EXPECT_EQ(weight.seen, 5);
  EXPECT_EQ(weight.matched, 3);
}

TEST(LineWeight, PaperMatchesAnyLineOfTheDatabase) {
  const LineDatabase database = databaseOf({line(20, 6), line(50, 6)});
  EXPECT_NEAR(lineWeight({line(50.2, 2), line(-70.2, 2)}, 0, database, method(WeightMethod::paper)).value, 1,
              1e-12);
  EXPECT_EQ(lineWeight({line(35, 2)}, 0, database, method(WeightMethod::paper)).value,
            LineWeightOptions().floor);
}

/// Calculated by hand: 6 m of wall at 20 deg, 2 m at 50 deg, sigma 2 deg; seen are 2 m at 110 deg (on the
/// first), 3 m at 52 deg (1 sigma off the second) and 1 m at 80 deg (on neither).
TEST(LineWeight, GradedByHand) {
  const LineDatabase database = databaseOf({line(20, 6), line(50, 2)});
  auto options = method(WeightMethod::graded);
  options.sigma = 2 * kDegree;
  const LineWeight weight = lineWeight({line(110, 2), line(52, 3), line(80, 1)}, 0, database, options);
  EXPECT_NEAR(weight.value, (2 * 0.75 + 3 * 0.25 * std::exp(-0.5)) / 6, 1e-9);
  EXPECT_EQ(weight.seen, 3);
  EXPECT_EQ(weight.matched, 2);
}

/// A wall observed thirty times counts twenty times as much as a newly inserted one.
TEST(LineWeight, GradedCountsEvidence) {
  LineDatabase database;
  for (int i = 0; i < 30; ++i) database.update({line(20, 6)}, LineDatabaseOptions(), AssociationOptions());
  database.update({line(60, 6)}, LineDatabaseOptions(), AssociationOptions());
  ASSERT_EQ(database.lines().size(), 2u);
  EXPECT_NEAR(lineWeight({line(20, 2)}, 0, database, {}).value, 20. / 21, 1e-9);
  EXPECT_NEAR(lineWeight({line(60, 2)}, 0, database, {}).value, 1. / 21, 1e-9);
}

/// Two building directions both count, which is impossible with eq. (9) or one dominating direction.
TEST(LineWeight, SeveralFramesCoexist) {
  const LineDatabase database = databaseOf({line(0, 6), line(90, 6), line(30, 6), line(120, 6)});
  const std::vector<LineSegment> wing{line(30, 4), line(120, 4)};
  const auto at = [&](WeightMethod m, double error) {
    return lineWeight(wing, error * kDegree, database, method(m)).value;
  };
  EXPECT_NEAR(at(WeightMethod::graded, 0), 0.5, 1e-9);
  EXPECT_LT(at(WeightMethod::graded, 1), 0.05);
  EXPECT_EQ(at(WeightMethod::dominatingDirection, 0),
            LineWeightOptions().floor);  // it is between the two directions
}

/// Calculated by hand: residuals 0, 2 deg (1 sigma) and 45 deg.
TEST(LineWeight, DominatingDirectionByHand) {
  const LineDatabase database = databaseOf({line(20, 6)});
  auto options = method(WeightMethod::dominatingDirection);
  options.sigma = 2 * kDegree;
  const LineWeight weight = lineWeight({line(110, 2), line(22, 3), line(65, 1)}, 0, database, options);
  EXPECT_NEAR(weight.value, (2 + 3 * std::exp(-0.5)) / 6, 1e-9);
  EXPECT_EQ(weight.seen, 3);
  EXPECT_EQ(weight.matched, 2);
}

TEST(LineWeight, MatchedIsWithinTwoSigma) {
  const LineDatabase database = databaseOf({line(0, 6)});
  auto options = method(WeightMethod::dominatingDirection);
  options.sigma = 2 * kDegree;
  EXPECT_EQ(lineWeight({line(3.99, 2)}, 0, database, options).matched, 1);
  EXPECT_EQ(lineWeight({line(4.01, 2)}, 0, database, options).matched, 0);
}

TEST(LineWeight, TheHeadingTurnsTheLinesIntoTheMap) {
  RandomStream random(1, 0, 0);
  for (const WeightMethod m : kMethods)
    for (int i = 0; i < 300; ++i) {
      const double turn = test::uniform(random, -M_PI, M_PI), heading = test::uniform(random, -9, 9);
      const LineDatabase database = databaseOf({line(turn / kDegree, 6)});
      EXPECT_NEAR(lineWeight({line((turn - heading) / kDegree, 2)}, heading, database, method(m)).value, 1,
                  1e-9);
    }
}

/// The threshold of eq. (9) must be as small as the spread of the headings: within it all weights are equal.
TEST(LineWeight, EqNineIsConstantWithinItsThreshold) {
  const LineDatabase database = databaseOf({line(0, 6), line(90, 6)});
  const std::vector<LineSegment> seen{line(0, 4), line(90, 2)};
  double previous = 2;
  for (const double error : {0.0, 0.5, 1.0, 1.5, 2.0, 2.5}) {
    LineWeightOptions paper = method(WeightMethod::paper);
    paper.threshold = 3 * kDegree;
    EXPECT_EQ(lineWeight(seen, error * kDegree, database, paper).value, 1);
    paper.threshold = 0.25 * kDegree;
    EXPECT_EQ(lineWeight(seen, error * kDegree, database, paper).value, error < 0.25 ? 1 : paper.floor);
    LineWeightOptions options = method(WeightMethod::graded);
    options.sigma = 1 * kDegree;
    const double graded = lineWeight(seen, error * kDegree, database, options).value;
    EXPECT_LT(graded, previous - 1e-3 * error);
    previous = graded;
  }
}

TEST(LineWeight, TheSlopeMatchesTheValue) {
  RandomStream random(3, 0, 0);
  int sloped = 0;
  for (int i = 0; i < 1000; ++i) {
    std::vector<LineSegment> known, seen;
    for (int k = 0; k < 1 + i % 5; ++k) known.push_back(test::randomSegment(random, 10));
    for (int k = 0; k < 1 + i % 7; ++k) seen.push_back(test::randomSegment(random, 10));
    const LineDatabase database = databaseOf(known);
    LineWeightOptions options = method(i % 2 ? WeightMethod::graded : WeightMethod::dominatingDirection);
    options.sigma = test::uniform(random, 1, 10) * kDegree;
    options.floor = 1e-6;
    const double heading = test::uniform(random, -M_PI, M_PI), step = 1e-6;
    const auto at = [&](double h) { return lineWeight(seen, h, database, options); };
    if (at(heading - step).value == options.floor || at(heading + step).value == options.floor) continue;
    const double slope = at(heading).slope;
    EXPECT_NEAR(slope, (at(heading + step).value - at(heading - step).value) / (2 * step),
                1e-4 * (1 + std::abs(slope)));
    sloped += std::abs(slope) > 0.01;
  }
  EXPECT_GT(sloped, 300);
}

TEST(LineWeight, StaysBetweenFloorAndOne) {
  RandomStream random(2, 0, 0);
  for (int i = 0; i < 3000; ++i) {
    std::vector<LineSegment> known, seen;
    for (int k = 0; k < 1 + i % 5; ++k) known.push_back(test::randomSegment(random, 10));
    for (int k = 0; k < 1 + i % 7; ++k) seen.push_back(test::randomSegment(random, 10));
    const LineDatabase database = databaseOf(known);
    for (const WeightMethod m : kMethods) {
      LineWeightOptions options = method(m);
      options.floor = test::uniform(random, 1e-6, 0.5);
      const LineWeight weight = lineWeight(seen, test::uniform(random, -M_PI, M_PI), database, options);
      EXPECT_GE(weight.value, options.floor);
      EXPECT_LE(weight.value, 1);
      EXPECT_EQ(weight.seen, static_cast<int>(seen.size()));
      EXPECT_LE(weight.matched, weight.seen);
    }
  }
}

/// A building of two parts, the second 50 m to the east at 30 deg, each with two walls of 6 m at right
/// angles.
LineDatabase buildingWithAWing() {
  const std::vector<LineSegment> part{makeSegment({-3, -2}, {3, -2}), makeSegment({4, -3}, {4, 3})};
  std::vector<LineSegment> walls = part;
  for (const LineSegment& wall : transformed(part, {50, 0, 30 * kDegree})) walls.push_back(wall);
  return databaseOf(walls);
}

/// By hand: near the robot, one direction has all the evidence; over the whole building, half of it.
TEST(LineWeight, ComparesWithTheWingThatTheRobotIsIn) {
  const LineDatabase building = buildingWithAWing();
  const std::vector<LineSegment> seen{line(0, 4), line(90, 2)};
  for (const WeightMethod m : {WeightMethod::graded, WeightMethod::frames}) {
    LineWeightOptions options = method(m);
    const auto at = [&](double x, double headingDeg) {
      return lineWeight(seen, headingDeg * kDegree, *comparedLines(building, {x, 0}, options), options);
    };
    const double d = 0.5 * options.sigma / kDegree;
    for (const double heading : {0, 30}) EXPECT_NEAR(at(0, heading).value, 0.5, 1e-9);
    options.radius = 10;
    EXPECT_NEAR(at(0, 0).value, 1, 1e-9);
    EXPECT_NEAR(at(0, d).value, std::exp(-0.125), 1e-9);
    EXPECT_EQ(at(0, 30).value, options.floor);
    EXPECT_EQ(at(0, 30).matched, 0);
    EXPECT_NEAR(at(50, 30).value, 1, 1e-9);
    EXPECT_EQ(at(50, 0).value, options.floor);
    EXPECT_EQ(at(25, 12).value, 1) << "no line is near";
    EXPECT_EQ(at(25, 12).seen, 2);
  }
}

TEST(LineWeight, NearIsTheDistanceFromTheSegment) {
  const LineDatabase database = databaseOf({makeSegment({-3, 2}, {3, 2})});
  const auto isNear = [&](double x, double y) { return !linesNear(database, {x, y}, 5).lines().empty(); };
  EXPECT_TRUE(isNear(0, 6.99));
  EXPECT_FALSE(isNear(0, 7.01));
  EXPECT_TRUE(isNear(0, -2.99));
  EXPECT_TRUE(isNear(7.99, 2));  // beyond the end
  EXPECT_FALSE(isNear(8.01, 2));
  EXPECT_FALSE(isNear(6.6, 5.6));  // 3.6 m past the end and 3.6 m aside
  EXPECT_EQ(linesNear(database, {1000, 0}, 0).lines().size(), 1u) << "no limit";
}

/// Lines at scattered angles are no frame: then `frames` has nothing to compare with.
TEST(LineWeight, FramesAreNeutralWithoutASharedDirection) {
  const LineDatabase scattered = databaseOf({line(0, 6), line(17, 6), line(33, 6), line(61, 6)});
  const std::vector<LineSegment> seen{line(45, 4)};
  const auto value = [&](WeightMethod m) {
    return lineWeight(seen, 0, *comparedLines(scattered, {0, 0}, method(m)), method(m)).value;
  };
  EXPECT_EQ(value(WeightMethod::frames), 1);
  EXPECT_EQ(value(WeightMethod::graded), LineWeightOptions().floor);
}

TEST(LineWeightOptions, NamesAndRanges) {
  const auto load = [](const char* line) {
    LineWeightOptions options;
    options.loadFromConfigFile(mrpt::config::CConfigFileMemory(std::string("[line_weight]\n") + line + "\n"),
                               "line_weight");
    return options;
  };
  EXPECT_EQ(load("method = paper").method, WeightMethod::paper);
  EXPECT_EQ(load("method = dominating_direction").method, WeightMethod::dominatingDirection);
  EXPECT_EQ(load("method = graded").method, WeightMethod::graded);
  EXPECT_NEAR(load("sigma_deg = 1").sigma, kDegree, 1e-12);
  for (const char* line :
       {"method = general", "sigma_deg = 0", "floor = 0", "floor = 1.5", "threshold_deg = 46"})
    EXPECT_THROW(load(line), InputError) << line;
}

}  // namespace
}  // namespace hybrid_slam
