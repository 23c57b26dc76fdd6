#include "lines/LineWeight.h"

#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>

#include "base/Errors.h"
#include "lines/TestScans.h"

namespace hybrid_slam {
namespace {

using namespace test;

using Method = LineWeightOptions::Method;

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

LineWeightOptions method(Method m) {
  LineWeightOptions options;
  options.method = m;
  return options;
}

const std::vector<Method> kMethods{Method::dominatingDirection, Method::paper};

TEST(LineWeight, NeutralWithoutLinesOrDatabase) {
  for (const Method m : kMethods) {
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
  for (const Method m : kMethods)
    EXPECT_EQ(lineWeight({line(30, 0)}, 0, databaseOf({line(0, 6)}), method(m)).value, 1);
}

/// eq. (9) by hand: 6 of 10 m parallel or perpendicular within 3 deg.
TEST(LineWeight, PaperByHand) {
  const LineDatabase database = databaseOf({line(20, 6)});
  const std::vector<LineSegment> seen{line(22.9, 1), line(110, 2), line(-72.9, 3), line(24, 2.5),
                                      line(65, 1.5)};
  const LineWeight weight = lineWeight(seen, 0, database, method(Method::paper));
  EXPECT_NEAR(weight.value, 0.6, 1e-12);
  EXPECT_EQ(weight.seen, 5);
  EXPECT_EQ(weight.matched, 3);
}

TEST(LineWeight, PaperMatchesAnyLineOfTheDatabase) {
  const LineDatabase database = databaseOf({line(20, 6), line(50, 6)});
  EXPECT_NEAR(lineWeight({line(51, 2), line(-71, 2)}, 0, database, method(Method::paper)).value, 1, 1e-12);
  EXPECT_EQ(lineWeight({line(35, 2)}, 0, database, method(Method::paper)).value, LineWeightOptions().floor);
}

/// By hand: residuals 0, 2 deg (1 sigma) and 45 deg.
TEST(LineWeight, GradedByHand) {
  const LineDatabase database = databaseOf({line(20, 6)});
  auto options = method(Method::dominatingDirection);
  options.sigma = 2 * kDegree;
  const LineWeight weight = lineWeight({line(110, 2), line(22, 3), line(65, 1)}, 0, database, options);
  EXPECT_NEAR(weight.value, (2 + 3 * std::exp(-0.5)) / 6, 1e-9);
  EXPECT_EQ(weight.seen, 3);
  EXPECT_EQ(weight.matched, 2);
}

TEST(LineWeight, MatchedIsWithinTwoSigma) {
  const LineDatabase database = databaseOf({line(0, 6)});
  auto options = method(Method::dominatingDirection);
  options.sigma = 2 * kDegree;
  EXPECT_EQ(lineWeight({line(3.99, 2)}, 0, database, options).matched, 1);
  EXPECT_EQ(lineWeight({line(4.01, 2)}, 0, database, options).matched, 0);
}

TEST(LineWeight, TheHeadingTurnsTheLinesIntoTheMap) {
  RandomStream random(1, 0, 0);
  for (const Method m : kMethods)
    for (int i = 0; i < 300; ++i) {
      const double turn = uniform(random, -M_PI, M_PI), heading = uniform(random, -9, 9);
      const LineDatabase database = databaseOf({line(turn / kDegree, 6)});
      EXPECT_NEAR(lineWeight({line((turn - heading) / kDegree, 2)}, heading, database, method(m)).value, 1,
                  1e-9);
    }
}

/// What the weight is for: the graded one falls off with the heading error, eq. (9) does not within 3 deg.
TEST(LineWeight, OnlyTheGradedOneTellsSmallHeadingErrorsApart) {
  const LineDatabase database = databaseOf({line(0, 6), line(90, 6)});
  const std::vector<LineSegment> seen{line(0, 4), line(90, 2)};
  double previous = 2;
  for (const double error : {0.0, 0.5, 1.0, 1.5, 2.0, 2.5}) {
    EXPECT_EQ(lineWeight(seen, error * kDegree, database, method(Method::paper)).value, 1);
    LineWeightOptions options = method(Method::dominatingDirection);
    options.sigma = 1 * kDegree;
    const double graded = lineWeight(seen, error * kDegree, database, options).value;
    EXPECT_LT(graded, previous - 1e-3 * error);
    previous = graded;
  }
}

TEST(LineWeight, StaysBetweenFloorAndOne) {
  RandomStream random(2, 0, 0);
  for (int i = 0; i < 3000; ++i) {
    std::vector<LineSegment> known, seen;
    for (int k = 0; k < 1 + i % 5; ++k) known.push_back(randomSegment(random, 10));
    for (int k = 0; k < 1 + i % 7; ++k) seen.push_back(randomSegment(random, 10));
    const LineDatabase database = databaseOf(known);
    for (const Method m : kMethods) {
      LineWeightOptions options = method(m);
      options.floor = uniform(random, 1e-6, 0.5);
      const LineWeight weight = lineWeight(seen, uniform(random, -M_PI, M_PI), database, options);
      EXPECT_GE(weight.value, options.floor);
      EXPECT_LE(weight.value, 1);
      EXPECT_EQ(weight.seen, static_cast<int>(seen.size()));
      EXPECT_LE(weight.matched, weight.seen);
    }
  }
}

TEST(LineWeightOptions, NamesAndRanges) {
  const auto load = [](const char* line) {
    LineWeightOptions options;
    options.loadFromConfigFile(mrpt::config::CConfigFileMemory(std::string("[line_weight]\n") + line + "\n"),
                               "line_weight");
    return options;
  };
  EXPECT_EQ(load("method = paper").method, Method::paper);
  EXPECT_EQ(load("method = dominating_direction").method, Method::dominatingDirection);
  EXPECT_NEAR(load("sigma_deg = 1").sigma, kDegree, 1e-12);
  for (const char* line :
       {"method = graded", "sigma_deg = 0", "floor = 0", "floor = 1.5", "threshold_deg = 46"})
    EXPECT_THROW(load(line), InputError) << line;
}

}  // namespace
}  // namespace hybrid_slam
