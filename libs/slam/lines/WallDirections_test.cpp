#include "slam/lines/WallDirections.h"

#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>

#include "testing/TestLines.h"

namespace hybrid_slam {
namespace {

using namespace test;

TEST(SetDirections, IsTheWeightedMeanWithinTheWindow) {
  std::vector<DatabaseLine> lines(3);
  lines[0].theta = 10 * kDegree;
  lines[0].length = 6;
  lines[1].theta = 100.3 * kDegree;  // 0.3 deg off perpendicular
  lines[1].length = 4;
  lines[1].count = 3;
  lines[2].theta = -79.5 * kDegree;  // 0.5 deg from the first: outside its window
  lines[2].length = 100;
  setDirections(lines, 0.5 * kDegree);
  EXPECT_NEAR(lines[0].direction, (10 + 0.64 * 12 * 0.3 / (6 + 0.64 * 12)) * kDegree, 1e-9);
  setDirections(lines, 0);
  for (const DatabaseLine& line : lines)
    EXPECT_NEAR(std::remainder(line.direction - line.theta, M_PI / 2), 0, 1e-12);
}

/// The sliding sums against the definition, line by line: few and many lines, clusters and all directions,
/// across 45 deg.
TEST(SetDirections, AreTheSumsOfTheDefinition) {
  RandomStream random(14, 0, 0);
  for (int i = 0; i < 400; ++i) {
    const double window = i % 10 == 0 ? 0 : test::uniform(random, 0.01, 22.5) * kDegree,
                 spread = test::uniform(random, 0, i % 3 == 0 ? 90 : 2) * kDegree,
                 centre = i % 4 == 0 ? M_PI / 4 : test::uniform(random, -M_PI, M_PI);
    std::vector<DatabaseLine> lines(static_cast<size_t>(test::uniform(random, 0, 60)));
    for (DatabaseLine& line : lines) {
      line.theta = mrpt::math::wrapToPi(centre + spread * random.gaussian());
      line.length = std::exp(test::uniform(random, -3, 5));
      line.count = 1 + static_cast<int>(test::uniform(random, 0, 30));
    }
    setDirections(lines, window);
    for (const DatabaseLine& line : lines) {
      double sum = 0, total = 0;
      for (const DatabaseLine& other : lines) {
        const double d = std::remainder(other.theta - line.theta, M_PI / 2);
        if (std::abs(d) >= window) continue;
        const double weight = evidence(other) * (1 - d * d / (window * window));
        sum += weight * d;
        total += weight;
      }
      const double expected = line.theta + (total > 0 ? sum / total : 0);
      ASSERT_NEAR(std::remainder(line.direction - expected, M_PI / 2), 0, 1e-9)
          << lines.size() << " lines, case " << i;
    }
  }
}

TEST(SetDirections, TurnWithTheMapAndKeepFramesApart) {
  RandomStream random(9, 0, 0);
  for (int i = 0; i < 300; ++i) {
    std::vector<DatabaseLine> lines(12), turned;
    const double frame = test::uniform(random, 2, 43) * kDegree, turn = test::uniform(random, -M_PI, M_PI);
    for (size_t k = 0; k < lines.size(); ++k) {
      lines[k].theta =
          (k % 2 ? frame : 0) + static_cast<double>(k % 4) * M_PI / 2 + 0.1 * kDegree * random.gaussian();
      lines[k].length = test::uniform(random, 1, 9);
    }
    turned = lines;
    for (DatabaseLine& line : turned) line.theta += turn;
    setDirections(lines, 0.5 * kDegree);
    setDirections(turned, 0.5 * kDegree);
    for (size_t k = 0; k < lines.size(); ++k) {
      EXPECT_NEAR(std::remainder(turned[k].direction - lines[k].direction - turn, M_PI / 2), 0, 1e-9);
      EXPECT_NEAR(std::remainder(lines[k].direction - (k % 2 ? frame : 0), M_PI / 2), 0, 0.4 * kDegree);
      EXPECT_LE(std::abs(lines[k].direction), M_PI / 4 + 1e-12);
    }
  }
}

TEST(AlignedHeadings, TurnTheSeenWallsToThoseOfTheMap) {
  const auto wall = [](double direction) {
    return makeSegment({2, 1}, {2 + 4 * std::cos(direction), 1 + 4 * std::sin(direction)});
  };
  const LineDatabase map({{wall(0.3), 3, 0, 0}});
  const auto headings = alignedHeadings({wall(0.1)}, map);
  ASSERT_EQ(headings.size(), 4);
  for (const double heading : headings) EXPECT_NEAR(wrapToRightAngle(heading - 0.2), 0, 1e-9);
  EXPECT_TRUE(alignedHeadings({}, map).empty());
  EXPECT_TRUE(alignedHeadings({wall(0.1)}, {}).empty());
}

}  // namespace
}  // namespace hybrid_slam
