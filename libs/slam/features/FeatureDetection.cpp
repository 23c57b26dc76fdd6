#include "slam/features/FeatureDetection.h"

#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "slam/features/CircleFit.h"

namespace hybrid_slam {

using mrpt::math::TPoint2D;

namespace {

constexpr int kLeastPoints = 5;  // of a wall at a corner, the corner included
constexpr size_t kLeastArcPoints = 7;
constexpr double kSplitDistance = 0.05;           // m: a door frame is 0.1 m deep
constexpr double kLeastVariance = 0.003 * 0.003;  // m^2: few points may fit by chance
constexpr double kLeastRadius = 0.05;             // m
constexpr double kCertainRadius = 0.25;           // standard deviation of a radius, as a share of it
constexpr double kMostDeviation = 0.3;            // m: standard deviation of a position
const double kSharpest = std::sin(mrpt::DEG2RAD(30.0));

/// A straight piece of a run and its points without the shared corners, which belong to neither wall.
struct Wall {
  PointRange piece;
  FittedLine line;
  double squares;   ///< sum of the squared distances, m^2
  double variance;  ///< of a point's distance, m^2
  double length;    ///< m
  TPoint2D middle;
  size_t count;
};

double atLeast(double squares, double freedom) {
  return std::max(squares / std::max(freedom, 1.0), kLeastVariance);
}

std::optional<Wall> wallOf(PointRange piece, PointRange run) {
  PointRange inner = piece;
  if (inner.first != run.first) ++inner.first;
  if (inner.last != run.last) --inner.last;
  const auto line = fitOrthogonal(inner);
  if (!line) return std::nullopt;
  const double n = static_cast<double>(inner.size()), rms = rmsDistance(inner, *line);
  const TPoint2D a = projected(inner.front(), line->rho, line->theta),
                 b = projected(inner.back(), line->rho, line->theta);
  return Wall{piece,          *line,         n * rms * rms, atLeast(n * rms * rms, n - 2),
              (b - a).norm(), (a + b) * 0.5, inner.size()};
}

/// Variance of the line across itself at a point on it: sigma^2 / n (1 + 12 d^2 / l^2), d from the middle.
double varianceAt(const Wall& wall, const TPoint2D& point) {
  const double d = (point - wall.middle).norm() / wall.length;
  return wall.variance / static_cast<double>(wall.count) * (1 + 12 * d * d);
}

std::optional<PointFeature> cornerOf(const Wall& a, const Wall& b, double minWall, double maxRms) {
  const auto isClear = [&](const Wall& w) {
    return w.length >= minWall && w.squares <= static_cast<double>(w.count) * maxRms * maxRms;
  };
  if (a.piece.last - 1 != b.piece.first || !isClear(a) || !isClear(b)) return std::nullopt;
  const double sine = std::sin(b.line.theta - a.line.theta);
  if (std::abs(sine) < kSharpest) return std::nullopt;
  Eigen::Matrix2d normals;
  normals << std::cos(a.line.theta), std::sin(a.line.theta), std::cos(b.line.theta), std::sin(b.line.theta);
  const Eigen::Matrix2d inverse = normals.inverse();
  const Eigen::Vector2d at = inverse * Eigen::Vector2d(a.line.rho, b.line.rho);

  PointFeature corner;
  corner.position = {at.x(), at.y()};
  // Not farther from the beam at the corner than its neighbours are.
  const TPoint2D& beam = b.piece.front();
  const double spacing = std::max((beam - *(b.piece.first - 1)).norm(), (beam - *(b.piece.first + 1)).norm());
  if ((corner.position - beam).norm() > std::max(spacing, kSplitDistance)) return std::nullopt;
  const Eigen::Vector2d variances(varianceAt(a, corner.position), varianceAt(b, corner.position));
  corner.covariance = inverse * variances.asDiagonal() * inverse.transpose();
  const TPoint2D toA = (a.middle - corner.position).unitarize(),
                 toB = (b.middle - corner.position).unitarize();
  // Beams are counter-clockwise: the walls of a room turn to the left.
  corner.kind = toA.x * toB.y - toA.y * toB.x < 0 ? FeatureKind::concaveCorner : FeatureKind::convexCorner;
  corner.direction = std::atan2(toA.y + toB.y, toA.x + toB.x);
  return corner;
}

/// The arc that the run is; empty if the straight pieces, of this variance, describe it as well.
std::optional<PointFeature> arcOf(PointRange run, double variance, double maxRms, double maxRadius) {
  if (run.size() < kLeastArcPoints) return std::nullopt;
  const auto circle = fitCircle(run);
  const double n = static_cast<double>(run.size());
  if (!circle || circle->radius < kLeastRadius || circle->radius > maxRadius ||
      circle->squares > n * maxRms * maxRms)
    return std::nullopt;
  const double own = atLeast(circle->squares, n - 3);
  if (own >= variance) return std::nullopt;
  PointFeature arc;
  arc.position = circle->centre;
  arc.covariance = own * circle->cofactor.topLeftCorner<2, 2>();
  arc.radius = circle->radius;
  arc.radiusVariance = own * circle->cofactor(2, 2);
  if (arc.radiusVariance > std::pow(kCertainRadius * arc.radius, 2)) return std::nullopt;
  const double toCentre = arc.position.norm();
  arc.kind = toCentre > arc.radius ? FeatureKind::pillar : FeatureKind::hall;
  // The near side of a pillar bulges; the far side of a ring around a pillar does not.
  const bool bulges = run.first[run.size() / 2].norm() < toCentre;
  if (bulges != (arc.kind == FeatureKind::pillar)) arc.kind = FeatureKind::hall;
  return arc;
}

bool isCertain(const PointFeature& feature) {
  return feature.covariance.allFinite() && feature.covariance.determinant() > 0 &&
         feature.covariance.trace() < kMostDeviation * kMostDeviation;
}

}  // namespace

std::vector<PointFeature> detectFeatures(const LaserScan& scan, const LineExtractionOptions& lines,
                                         const FeatureOptions& options) {
  SegmentationOptions segmentation = lines.segmentation;
  segmentation.minPoints = kLeastPoints;
  segmentation.splitDistance = kSplitDistance;
  std::vector<PointFeature> features;
  const auto add = [&](const std::optional<PointFeature>& feature) {
    if (feature && isCertain(*feature)) features.push_back(transformed(*feature, scan.sensorPose));
  };
  const SegmentedScan segmented(scan, segmentation);
  for (const PointRange& run : segmented.runs()) {
    std::vector<PointRange> pieces;
    splitAtCorners(run, segmentation, pieces);
    std::vector<Wall> walls;
    double squares = 0, freedom = 0;
    for (const PointRange& piece : pieces)
      if (const auto wall = wallOf(piece, run)) {
        walls.push_back(*wall);
        squares += wall->squares;
        freedom += static_cast<double>(wall->count) - 2;
      }
    const double variance = walls.empty() ? lines.fit.maxRms * lines.fit.maxRms : atLeast(squares, freedom);
    const auto arc = arcOf(run, variance, lines.fit.maxRms, options.maxRadius);
    add(arc);
    if (arc) continue;
    for (size_t i = 1; i < walls.size(); ++i)
      add(cornerOf(walls[i - 1], walls[i], options.minWall, lines.fit.maxRms));
  }
  return features;
}

PointFeature withModelError(const PointFeature& feature, double sigma) {
  constexpr double kHeading = mrpt::DEG2RAD(0.5);
  PointFeature result = feature;
  const Eigen::Vector2d across(-feature.position.y, feature.position.x);
  result.covariance += sigma * sigma * Eigen::Matrix2d::Identity();
  result.covariance += kHeading * kHeading * across * across.transpose();
  return result;
}

}  // namespace hybrid_slam
