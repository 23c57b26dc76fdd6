#include "slam/lines/LineExtractor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include "testing/TestLines.h"

namespace hybrid_slam {
namespace {

using namespace test;

using Method = LineFitOptions::Method;

const LineExtractionOptions kDefault;
const test::Walls kRoom = test::polygon({{-3, -2}, {5, -2}, {5, 4}, {-3, 4}});

/// Index of the wall that a line in the map frame coincides with, within 0.3 deg and 1 cm, or -1.
int wallOf(const LineSegment& line, const test::Walls& walls) {
  for (size_t i = 0; i < walls.size(); ++i) {
    const LineSegment wall = makeSegment(walls[i].first, walls[i].second);
    if (test::angleBetween(wall.theta, line.theta) < 0.3 * kDegree &&
        std::abs(signedDistance(middle(line), wall.rho, wall.theta)) < 0.01)
      return static_cast<int>(i);
  }
  return -1;
}

/// A full turn of a laser at the robot's centre.
LaserScan roomScan(const TPose2D& robot, double noise, RandomStream& random) {
  return test::scanOf(kRoom, robot, {}, 720, 359.5 * kDegree, noise, random);
}

/// Expects each wall of the room once, whole, and within 0.1 deg and 5 mm.
void expectTheFourWalls(const std::vector<LineSegment>& lines, const TPose2D& robot, double lengthTolerance) {
  std::set<int> found;
  for (const LineSegment& seen : lines) {
    const LineSegment line = transformed(seen, robot);
    const int k = wallOf(line, kRoom);
    ASSERT_GE(k, 0);
    found.insert(k);
    const auto& ends = kRoom[static_cast<size_t>(k)];
    const LineSegment wall = makeSegment(ends.first, ends.second);
    EXPECT_LT(test::angleBetween(line.theta, wall.theta), 0.1 * kDegree) << k;
    EXPECT_NEAR(signedDistance(middle(line), wall.rho, wall.theta), 0, 0.005) << k;
    EXPECT_NEAR(line.length, wall.length, lengthTolerance) << k;
  }
  EXPECT_EQ(lines.size(), 4u);
  EXPECT_EQ(found.size(), 4u);
}

class EveryExtractor : public testing::TestWithParam<const LineExtractor*> {};

TEST_P(EveryExtractor, FindsTheWallsOfARoom) {
  LineExtractionOptions options;
  options.method = GetParam();
  RandomStream random(6, 0, 0);
  double total = 0, onWalls = 0;
  for (int i = 0; i < 200; ++i) {
    const TPose2D robot(test::uniform(random, -1, 3), test::uniform(random, 0, 2),
                        test::uniform(random, -M_PI, M_PI));
    for (const LineSegment& line : extractLines(roomScan(robot, 0.01, random), options)) {
      total += line.length;
      if (wallOf(transformed(line, robot), kRoom) >= 0) onWalls += line.length;
    }
  }
  EXPECT_GT(total, 0.95 * 200 * 28);
  EXPECT_LT(total, 200 * 28);
  EXPECT_GT(onWalls, 0.97 * total);
}

TEST_P(EveryExtractor, FindsNothingInAnEmptyScan) {
  LineExtractionOptions options;
  options.method = GetParam();
  LaserScan scan;
  EXPECT_TRUE(extractLines(scan, options).empty());
  scan.beams.resize(541);  // all invalid
  EXPECT_TRUE(extractLines(scan, options).empty());
  scan.beams.assign(1, {0, 1, true});
  EXPECT_TRUE(extractLines(scan, options).empty());
}

TEST_P(EveryExtractor, FindsTheFourWallsOfARoomWithoutNoise) {
  LineExtractionOptions options;
  options.method = GetParam();
  RandomStream random(11, 0, 0);
  const TPose2D robot(0.4, 0.3, 0.2);
  expectTheFourWalls(extractLines(roomScan(robot, 0, random), options), robot, 0.3);
}

TEST_P(EveryExtractor, ADoorDividesAWall) {
  LineExtractionOptions options;
  options.method = GetParam();
  RandomStream random(12, 0, 0);
  // Two pieces of x = 3 with a door of 1 m between them, and the wall of the next room behind it.
  const test::Walls walls{{{3, -3}, {3, -0.5}}, {{3, 0.5}, {3, 3}}, {{6, -2}, {6, 2}}};
  for (int i = 0; i < 20; ++i) {
    const auto lines = extractLines(test::scanOf(walls, {}, {}, 541, 270 * kDegree, 0.01, random), options);
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_NEAR(lines[0].rho, 3, 0.02);
    EXPECT_NEAR(lines[0].length, 2.5, 0.15);
    EXPECT_NEAR(lines[1].rho, 6, 0.02);
    EXPECT_NEAR(lines[1].length, 2, 0.15);
    EXPECT_NEAR(lines[2].rho, 3, 0.02);
    EXPECT_NEAR(lines[2].length, 2.5, 0.15);
  }
}

TEST_P(EveryExtractor, APillarDividesAWall) {
  LineExtractionOptions options;
  options.method = GetParam();
  RandomStream random(16, 0, 0);
  // 0.3 m deep: less than the gap that ends a run at this range.
  test::Walls walls = test::polygon({{4.7, -0.25}, {5, -0.25}, {5, 0.25}, {4.7, 0.25}});
  walls.push_back({{5, -3}, {5, 3}});
  for (int i = 0; i < 20; ++i) {
    const auto lines = extractLines(test::scanOf(walls, {}, {}, 541, 270 * kDegree, 0.01, random), options);
    ASSERT_EQ(lines.size(), 2u);
    for (const LineSegment& line : lines) {
      EXPECT_NEAR(line.rho, 5, 0.02);
      EXPECT_NEAR(line.length, 2.7, 0.3);  // regression may lose half a window at the pillar
    }
  }
}

TEST_P(EveryExtractor, FindsNoLinesInPillarsAndClouds) {
  LineExtractionOptions options;
  options.method = GetParam();
  RandomStream random(13, 0, 0);
  for (int i = 0; i < 20; ++i) {
    std::vector<TPoint2D> corners;
    for (int k = 0; k < 60; ++k)
      corners.emplace_back(2 + 0.4 * std::cos(6 * k * kDegree), 0.4 * std::sin(6 * k * kDegree));
    LaserScan scan = test::scanOf(test::polygon(corners), {}, {}, 541, 270 * kDegree, 0.01, random);
    EXPECT_TRUE(extractLines(scan, options).empty()) << "pillar";
    for (Beam& beam : scan.beams) beam = {beam.angle, 4 + 0.15 * random.gaussian(), true};
    EXPECT_TRUE(extractLines(scan, options).empty()) << "cloud";
  }
}

TEST_P(EveryExtractor, SurvivesScansOfOneRange) {
  LineExtractionOptions options;
  options.method = GetParam();
  RandomStream random(14, 0, 0);
  for (const double range : {1e-9, 0.05, 1.0, 20.0}) {
    LaserScan scan = test::scanOf({}, {}, {}, 541, 270 * kDegree, 0, random);
    for (Beam& beam : scan.beams) beam = {beam.angle, range, true};
    for (const LineSegment& line : extractLines(scan, options)) {  // chords of the circle
      EXPECT_LE(line.rho, range);
      EXPECT_LE(line.length, 2 * range);
    }
    for (Beam& beam : scan.beams) beam = {0, range, true};  // the same point again and again
    EXPECT_TRUE(extractLines(scan, options).empty());
  }
}

/// Random walls: every line is on one of them and long enough. Extracting the scan again gives the same
/// lines, also after other scans.
TEST_P(EveryExtractor, FindsLinesOnWallsAgainAndAgain) {
  LineExtractionOptions options;
  options.method = GetParam();
  RandomStream random(15, 0, 0);
  std::vector<LaserScan> scans;
  std::vector<std::vector<LineSegment>> lines;
  double total = 0, onWalls = 0;
  for (int i = 0; i < 100; ++i) {
    test::Walls walls;
    for (int k = 0; k < 6; ++k) {
      const LineSegment wall = test::randomSegment(random, 8);
      walls.emplace_back(wall.start, wall.end);
    }
    scans.push_back(test::scanOf(walls, {}, {}, 541, 270 * kDegree, 0.01, random));
    lines.push_back(extractLines(scans.back(), options));
    for (const LineSegment& line : lines.back()) {
      EXPECT_GE(line.length, options.segmentation.minLength);
      total += line.length;
      double nearest = 1;
      for (const auto& [a, b] : walls) {
        const LineSegment wall = makeSegment(a, b);
        if (test::angleBetween(wall.theta, line.theta) < 3 * kDegree)
          nearest = std::min(nearest, std::abs(signedDistance(middle(line), wall.rho, wall.theta)));
      }
      if (nearest < 0.03) onWalls += line.length;
    }
  }
  EXPECT_GT(total, 1000);
  EXPECT_GT(onWalls, 0.95 * total);
  for (size_t i = scans.size(); i-- > 0;) {
    const auto again = extractLines(scans[i], options);
    ASSERT_EQ(again.size(), lines[i].size());
    for (size_t k = 0; k < again.size(); ++k) {
      EXPECT_EQ(again[k].rho, lines[i][k].rho);
      EXPECT_EQ(again[k].theta, lines[i][k].theta);
      EXPECT_EQ(again[k].length, lines[i][k].length);
    }
  }
}

TEST_P(EveryExtractor, ALineHasTheLeastNumberOfPoints) {
  LineExtractionOptions options;
  options.method = GetParam();
  options.segmentation.minPoints = 40;
  RandomStream random(16, 0, 0);
  size_t lines = 0;
  for (int i = 0; i < 20; ++i) {
    const TPose2D robot(test::uniform(random, -1, 3), test::uniform(random, 0, 2), 0);
    const LaserScan scan = roomScan(robot, 0.02, random);
    for (const LineSegment& line : extractLines(scan, options)) {
      const TPoint2D along = (line.end - line.start) * (1 / line.length);
      size_t points = 0;
      for (const auto& beam : scan.beams) {
        const TPoint2D p(beam.range * std::cos(beam.angle), beam.range * std::sin(beam.angle)),
            q = p - line.start;
        const double at = q.x * along.x + q.y * along.y;
        points +=
            -0.1 < at && at < line.length + 0.1 && std::abs(signedDistance(p, line.rho, line.theta)) < 0.3;
      }
      EXPECT_GE(points, 40u);
      ++lines;
    }
  }
  EXPECT_GT(lines, 20u);
}

INSTANTIATE_TEST_SUITE_P(Methods, EveryExtractor, testing::ValuesIn(lineExtractors()),
                         [](const auto& extractor) { return extractor.param->name; });

TEST(LineExtractor, ARectangularRoomGivesItsFourWalls) {
  RandomStream random(1, 0, 0);
  for (int i = 0; i < 200; ++i) {
    const TPose2D robot(test::uniform(random, -1, 3), test::uniform(random, 0, 2),
                        test::uniform(random, -M_PI, M_PI));
    expectTheFourWalls(extractLines(roomScan(robot, 0, random), kDefault), robot,
                       0.35);  // a spacing of the beams on the wall, up to 0.17 m, at either end
  }
}

/// Noise may shift the split at a corner by a beam or two, which occasionally leaves a short, skewed piece.
TEST(LineExtractor, ARoomWithNoise) {
  RandomStream random(2, 0, 0);
  double total = 0, onWalls = 0;
  for (int i = 0; i < 200; ++i) {
    const TPose2D robot(test::uniform(random, -1, 3), test::uniform(random, 0, 2),
                        test::uniform(random, -M_PI, M_PI));
    for (const LineSegment& line : extractLines(roomScan(robot, 0.012, random), kDefault)) {
      total += line.length;
      if (wallOf(transformed(line, robot), kRoom) >= 0) onWalls += line.length;
    }
  }
  EXPECT_GT(total, 0.97 * 200 * 28);
  EXPECT_LT(total, 200 * 28);
  EXPECT_GT(onWalls, 0.995 * total);
}

TEST(LineExtractor, AHalfCircleScanSeesTheThreeWallsAheadOfIt) {
  RandomStream random(2, 0, 0);
  const auto lines =
      extractLines(test::scanOf(kRoom, {-2.9, 1, 0}, {}, 541, 180 * kDegree, 0, random), kDefault);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_NEAR(lines[0].theta, -90 * kDegree, 1e-6);
  EXPECT_NEAR(lines[0].rho, 3, 1e-6);
  EXPECT_NEAR(lines[1].theta, 0, 1e-6);
  EXPECT_NEAR(lines[1].rho, 7.9, 1e-6);
  EXPECT_NEAR(lines[1].length, 6, 0.1);
  EXPECT_NEAR(lines[2].theta, 90 * kDegree, 1e-6);
  EXPECT_NEAR(lines[2].rho, 3, 1e-6);
}

TEST(LineExtractor, CornersSplitUnlessSwitchedOff) {
  RandomStream random(3, 0, 0);
  const LaserScan scan = test::scanOf(kRoom, {1, 1, 0.4}, {}, 541, 270 * kDegree, 0.01, random);
  EXPECT_GE(extractLines(scan, kDefault).size(), 4u);
  LineExtractionOptions whole;
  whole.segmentation.split = false;
  // One run round three corners: no line fits it.
  EXPECT_TRUE(extractLines(scan, whole).empty());
}

TEST(LineExtractor, LinesShorterThanTheMinimumAreDropped) {
  RandomStream random(4, 0, 0);
  const LaserScan scan = test::scanOf({{{2, -0.5}, {2, 0.5}}}, {}, {}, 541, 270 * kDegree, 0, random);
  LineExtractionOptions options;
  options.segmentation.minLength = 0.9;
  EXPECT_EQ(extractLines(scan, options).size(), 1u);
  options.segmentation.minLength = 1.1;
  EXPECT_TRUE(extractLines(scan, options).empty());
}

/// The same walls through sensors that are offset, turned, upside down or clockwise give the same lines.
TEST(LineExtractor, MountingOfTheSensorDoesNotMatter) {
  const TPose2D robot(0.5, 0.7, 0.3);
  for (const bool upsideDown : {false, true})
    for (const bool rightToLeft : {true, false})
      for (const double yaw : {0.0, 0.6, -2.0}) {
        mrpt::obs::CObservation2DRangeScan o;
        o.aperture = static_cast<float>(270 * kDegree);
        o.maxRange = 20;
        o.rightToLeft = rightToLeft;
        o.sensorPose = mrpt::poses::CPose3D(0.4, -0.1, 0.3, yaw, 0, upsideDown ? M_PI : 0);
        o.resizeScan(541);
        const TPoint2D origin = robot.composePoint(TPoint2D(0.4, -0.1));
        for (size_t i = 0; i < 541; ++i) {
          const double angle = o.getScanAngle(i);
          double x = 0, y = 0, z = 0;  // the beam's direction in the robot frame, by 3D geometry
          o.sensorPose.composePoint(std::cos(angle), std::sin(angle), 0, x, y, z);
          const double heading = robot.phi + std::atan2(y + 0.1, x - 0.4);
          o.setScanRange(i, static_cast<float>(castRay(kRoom, origin, heading)));
          o.setScanRangeValidity(i, true);
        }
        const auto lines = extractLines(toLaserScan(o, 20), kDefault);
        EXPECT_GE(lines.size(), 3u);
        for (const LineSegment& line : lines) {
          const LineSegment inMap = transformed(line, robot);
          EXPECT_GE(wallOf(inMap, kRoom), 0)
              << "rho " << inMap.rho << " theta " << inMap.theta << " yaw " << yaw << " upside down "
              << upsideDown << " right to left " << rightToLeft;
        }
      }
}

TEST(LineExtractor, ThePapersFitLosesTheWallAhead) {
  RandomStream random(5, 0, 0);
  // Two walls apart from each other: ahead (vertical in the sensor frame) and to the left.
  const test::Walls walls{{{4, -2}, {4, 2}}, {{-3, 3}, {1, 3}}};
  const LaserScan scan = test::scanOf(walls, {}, {}, 541, 270 * kDegree, 0.012, random);
  EXPECT_EQ(extractLines(scan, kDefault).size(), 2u);
  LineExtractionOptions paper;
  paper.segmentation.split = false;
  paper.fit.method = Method::paper;
  const auto lines = extractLines(scan, paper);
  ASSERT_EQ(lines.size(), 1u);  // eq. (5) drops the one along y
  EXPECT_NEAR(lines[0].theta, 90 * kDegree, 0.5 * kDegree);
  EXPECT_NEAR(lines[0].rho, 3, 0.02);
}

}  // namespace
}  // namespace hybrid_slam
