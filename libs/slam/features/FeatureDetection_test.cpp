#include "slam/features/FeatureDetection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "testing/TestScans.h"

namespace hybrid_slam {
namespace {

using namespace test;

constexpr size_t kBeams = 541;
constexpr double kAperture = 270 * kDegree;

Walls circle(const TPoint2D& centre, double radius) {
  std::vector<TPoint2D> points;
  for (int i = 0; i < 720; ++i)
    points.push_back(centre + TPoint2D(radius * std::cos(i * M_PI / 360), radius * std::sin(i * M_PI / 360)));
  return polygon(points);
}

LaserScan scanAt(const Walls& walls, const TPose2D& robot, double noise, uint64_t seed = 1) {
  RandomStream random(seed, 0, 0);
  return scanOf(walls, robot, {}, kBeams, kAperture, noise, random);
}

std::vector<PointFeature> featuresOf(const LaserScan& scan) {
  return detectFeatures(scan, LineExtractionOptions(), FeatureOptions());
}

/// Returns the only feature within 0.3 m of a point; empty unless there is exactly one.
std::optional<PointFeature> featureAt(const std::vector<PointFeature>& features, const TPoint2D& point) {
  std::optional<PointFeature> found;
  for (const PointFeature& feature : features)
    if ((feature.position - point).norm() < 0.3) {
      if (found) return std::nullopt;
      found = feature;
    }
  return found;
}

TEST(FeatureDetection, CornersOfARoomAreWhereTheWallsMeet) {
  // A recess has two convex corners and two concave ones; the laser sees all of the room's front.
  const Walls walls = polygon({{-4, -3}, {4, -3}, {4, 3}, {1, 3}, {1, 4}, {-1, 4}, {-1, 3}, {-4, 3}});
  const auto features = featuresOf(scanAt(walls, {0, 0, M_PI / 2}, 0));
  const struct {
    TPoint2D at;
    FeatureKind kind;
    double direction;
  } expected[] = {{{4, 3}, FeatureKind::concaveCorner, -135}, {{1, 3}, FeatureKind::convexCorner, 45},
                  {{1, 4}, FeatureKind::concaveCorner, -135}, {{-1, 4}, FeatureKind::concaveCorner, -45},
                  {{-1, 3}, FeatureKind::convexCorner, 135},  {{-4, 3}, FeatureKind::concaveCorner, -45}};
  for (const auto& corner : expected) {
    const TPoint2D seen(corner.at.y, -corner.at.x);  // robot frame
    const auto found = featureAt(features, seen);
    ASSERT_TRUE(found) << corner.at;
    EXPECT_LT((found->position - seen).norm(), 1e-6);
    EXPECT_EQ(found->kind, corner.kind);
    EXPECT_NEAR(std::remainder(found->direction + M_PI / 2 - corner.direction * kDegree, 2 * M_PI), 0,
                5 * kDegree);
  }
  for (const PointFeature& feature : features) EXPECT_FALSE(feature.isArc());
}

/// A corridor with a pillar 0.3 m deep and 0.5 m wide at one wall and a door frame 0.15 m deep and 0.9 m wide
/// at the other.
const Walls kCorridor = polygon({{-20, -1.25},
                                 {5, -1.25},
                                 {5, -0.95},
                                 {5.5, -0.95},
                                 {5.5, -1.25},
                                 {20, -1.25},
                                 {20, 1.25},
                                 {4.4, 1.25},
                                 {4.4, 1.4},
                                 {3.5, 1.4},
                                 {3.5, 1.25},
                                 {-20, 1.25}});

TEST(FeatureDetection, PillarsAndDoorFramesOfACorridorShow) {
  constexpr int kScans = 50;
  int pillar = 0, frame = 0;
  for (uint64_t seed = 1; seed <= kScans; ++seed) {
    const TPose2D robot(static_cast<double>(seed) * 0.05, 0, 0);
    const auto features = featuresOf(scanAt(kCorridor, robot, 0.012, seed));
    const auto shows = [&](const TPoint2D& at) {
      return std::any_of(features.begin(), features.end(), [&](const PointFeature& feature) {
        return (robot.composePoint(feature.position) - at).norm() < 0.05;
      });
    };
    pillar += shows({5, -0.95});
    frame += shows({4.4, 1.25}) || shows({3.5, 1.25});
  }
  EXPECT_GE(pillar, 0.8 * kScans);
  EXPECT_GE(frame, 0.8 * kScans);
}

TEST(FeatureDetection, AWallEndsWhereTheLaserSeesFarther) {
  // An opening from (1, 2) to (2, 2); the wall behind it is partly hidden by its edges.
  const Walls walls{{{-3, 2}, {1, 2}}, {{2, 2}, {5, 2}}, {{-3, 6}, {10, 6}}};
  const auto features = featuresOf(scanAt(walls, {0, 0, 0}, 0));
  ASSERT_EQ(features.size(), 2u);  // not the ends of what is visible of the wall behind
  for (const PointFeature& end : features) {
    EXPECT_EQ(end.kind, FeatureKind::wallEnd);
    const bool isRight = end.position.x > 1.5;
    const Eigen::Vector2d off(end.position.x - (isRight ? 2 : 1), end.position.y - 2);
    EXPECT_LT(std::abs(off.x()), 2 * std::sqrt(end.covariance(0, 0)));
    EXPECT_LT(std::abs(off.y()), 1e-6);
    EXPECT_GT(end.covariance(0, 0), end.covariance(1, 1)) << "between two beams";
    EXPECT_NEAR(std::remainder(end.direction - (isRight ? 0 : M_PI), 2 * M_PI), 0, 1e-6);
  }
}

TEST(FeatureDetection, AWallThatTheLaserLosesHasNoEnd) {
  LaserScan scan = scanAt({{{-3, 2}, {5, 2}}, {{-3, 6}, {10, 6}}}, {0, 0, M_PI / 2}, 0);
  EXPECT_TRUE(featuresOf(scan).empty()) << "beyond the end nothing is seen";
  scan.beams[300].valid = false;
  EXPECT_TRUE(featuresOf(scan).empty());
}

TEST(FeatureDetection, ABuildingsCornerIsConvex) {
  const auto features = featuresOf(scanAt(polygon({{2, 0}, {4, -2}, {6, 0}, {4, 2}}), {}, 0));
  ASSERT_EQ(features.size(), 1u);
  EXPECT_EQ(features[0].kind, FeatureKind::convexCorner);
  EXPECT_LT((features[0].position - TPoint2D(2, 0)).norm(), 1e-6);
  EXPECT_NEAR(features[0].direction, 0, 1e-6);
}

TEST(FeatureDetection, APillarHasItsCentreAndRadius) {
  for (const double radius : {0.15, 0.3, 0.6}) {
    const auto features = featuresOf(scanAt(circle({2, 0.5}, radius), {}, 0));
    ASSERT_EQ(features.size(), 1u) << radius;
    EXPECT_EQ(features[0].kind, FeatureKind::pillar);
    EXPECT_LT((features[0].position - TPoint2D(2, 0.5)).norm(), 1e-4);
    EXPECT_NEAR(features[0].radius, radius, 1e-4);
  }
}

TEST(FeatureDetection, ARoundHallIsAnArcAroundTheLaser) {
  const auto features = featuresOf(scanAt(circle({1, -2}, 6), {}, 0.01));
  ASSERT_EQ(features.size(), 1u);
  EXPECT_EQ(features[0].kind, FeatureKind::hall);
  EXPECT_LT((features[0].position - TPoint2D(1, -2)).norm(), 0.01);
  EXPECT_NEAR(features[0].radius, 6, 0.01);
}

TEST(FeatureDetection, ABoxIsNoPillarAndAPillarNoBox) {
  int corners = 0, pillars = 0;
  const Walls box = polygon({{2, 0}, {2.35, -0.35}, {2.7, 0}, {2.35, 0.35}}), round = circle({2.2, 0}, 0.25);
  for (uint64_t seed = 1; seed <= 50; ++seed) {
    for (const PointFeature& feature : featuresOf(scanAt(box, {}, 0.01, seed))) {
      EXPECT_EQ(feature.kind, FeatureKind::convexCorner);
      ++corners;
    }
    for (const PointFeature& feature : featuresOf(scanAt(round, {}, 0.01, seed))) {
      EXPECT_EQ(feature.kind, FeatureKind::pillar);
      ++pillars;
    }
  }
  EXPECT_GE(corners, 45);
  EXPECT_GE(pillars, 40);
}

TEST(FeatureDetection, AStraightWallHasNoFeature) {
  for (uint64_t seed = 1; seed <= 100; ++seed)
    EXPECT_TRUE(featuresOf(scanAt({{{-30, 1.5}, {30, 1.5}}}, {0, 0, 1}, 0.02, seed)).empty());
}

TEST(FeatureDetection, TheSensorsPlaceIsThatOfTheFeature) {
  LaserScan scan = scanAt(circle({2, 0}, 0.3), {}, 0);
  scan.sensorPose = {0.2, 0.1, M_PI / 2};
  const auto features = featuresOf(scan);
  ASSERT_EQ(features.size(), 1u);
  EXPECT_LT((features[0].position - TPoint2D(0.2, 2.1)).norm(), 1e-4);
}

/// Mean of the squared Mahalanobis distances from the mean over many scans: 2 if the covariance is right.
double meanSquares(const Walls& walls, const TPoint2D& about, FeatureKind kind) {
  std::vector<PointFeature> seen;
  for (uint64_t seed = 1; seed <= 1000; ++seed)
    for (const PointFeature& feature : featuresOf(scanAt(walls, {}, 0.01, seed)))
      if (feature.kind == kind && (feature.position - about).norm() < 0.5) seen.push_back(feature);
  EXPECT_GT(seen.size(), 900u);
  TPoint2D mean(0, 0);
  for (const PointFeature& feature : seen)
    mean += feature.position * (1.0 / static_cast<double>(seen.size()));
  EXPECT_LT((mean - about).norm(), 0.01);
  double squares = 0;
  for (const PointFeature& feature : seen) {
    const Eigen::Vector2d off(feature.position.x - mean.x, feature.position.y - mean.y);
    squares += off.dot(feature.covariance.inverse() * off) / static_cast<double>(seen.size());
  }
  return squares;
}

TEST(FeatureDetection, TheCovarianceIsTheSpreadOfNoisyScans) {
  const Walls room = polygon({{-4, -3}, {4, -3}, {4, 3}, {-4, 3}});
  const double corner = meanSquares(room, {4, 3}, FeatureKind::concaveCorner);
  EXPECT_GT(corner, 1.6);
  EXPECT_LT(corner, 2.4);
  const double pillar = meanSquares(circle({2, 0}, 0.3), {2, 0}, FeatureKind::pillar);
  EXPECT_GT(pillar, 0.95);  // too cautious
  EXPECT_LT(pillar, 1.45);
  const double hall = meanSquares(circle({1, -2}, 6), {1, -2}, FeatureKind::hall);
  EXPECT_GT(hall, 1.6);
  EXPECT_LT(hall, 2.4);
}

TEST(FeatureDetection, ScansWithoutShapeGiveNoFeatureOrAFiniteOne) {
  RandomStream random(5, 0, 0);
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const auto expectFinite = [](const LaserScan& scan) {
    for (const PointFeature& f : featuresOf(scan)) {
      EXPECT_TRUE(std::isfinite(f.position.x) && std::isfinite(f.position.y) && std::isfinite(f.direction));
      EXPECT_TRUE(f.covariance.allFinite() && f.covariance.determinant() > 0);
      EXPECT_TRUE(std::isfinite(f.radius) && std::isfinite(f.radiusVariance));
    }
  };
  for (const size_t beams : {0u, 1u, 2u, 5u, 361u})
    for (const double range : {0.0, 1e-9, 1.0, 1e6}) {
      LaserScan scan;
      for (size_t i = 0; i < beams; ++i)
        scan.beams.push_back({0.0175 * static_cast<double>(i) - 1.5, range, true});
      expectFinite(scan);  // equal ranges: an arc around the laser
      for (Beam& beam : scan.beams) beam.angle = 0;
      expectFinite(scan);
      for (Beam& beam : scan.beams) beam.valid = false, beam.range = nan;
      EXPECT_TRUE(featuresOf(scan).empty());
      for (Beam& beam : scan.beams) beam.valid = random.uniform() < 0.5, beam.range = beam.valid ? 1 : inf;
      expectFinite(scan);
    }
  for (int i = 0; i < 300; ++i) {
    LaserScan scan;
    const double step = std::pow(10, uniform(random, -4, 1));
    double range = 5;
    for (int k = 0; k < 181; ++k) {
      range = std::abs(range + step * random.gaussian());
      scan.beams.push_back({k * kDegree - 1.5, range, random.uniform() < 0.95});
    }
    expectFinite(scan);
  }
}

TEST(WithModelError, AddsThePositionAndTheHeading) {
  PointFeature feature;
  feature.position = {0, 10};
  feature.covariance = 1e-4 * Eigen::Matrix2d::Identity();
  const PointFeature result = withModelError(feature, 0.05);
  EXPECT_NEAR(result.covariance(1, 1), 1e-4 + 0.0025, 1e-12);
  EXPECT_NEAR(result.covariance(0, 0), 1e-4 + 0.0025 + std::pow(10 * 0.5 * kDegree, 2), 1e-12);
  EXPECT_EQ(result.covariance(0, 1), 0);
}

}  // namespace
}  // namespace hybrid_slam
