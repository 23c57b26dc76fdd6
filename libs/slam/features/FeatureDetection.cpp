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
constexpr double kMostSpacing = 0.1;              // m between the beams at the end of a wall
constexpr double kSimilar = 2;  // ratio of variances: circle and straight pieces fit about equally well
constexpr double kClear = 4;    // standard deviations
// m of gap per m of range. Less than for lines: with those of a pillar and of the wall behind it in one run,
// their corners would move with the laser.
constexpr double kGapRelative = 0.03;
const double kSharpest = std::sin(mrpt::DEG2RAD(30.0));

/// A straight piece of a run. Its line is that of its points without the shared corners, which belong to
/// neither wall.
struct WallPiece {
  PointRange piece;
  PointRange inner;  ///< without the shared corners
  FittedLine line;
  double squares;   ///< sum of the squared distances, m^2
  double variance;  ///< of a point's distance, m^2
  double length;    ///< m
  TPoint2D middle;
};

double atLeast(double squares, double freedom) {
  return std::max(squares / std::max(freedom, 1.0), kLeastVariance);
}

std::optional<WallPiece> wallOf(PointRange piece, PointRange run) {
  PointRange inner = piece;
  if (inner.first != run.first) ++inner.first;
  if (inner.last != run.last) --inner.last;
  const auto line = fitOrthogonal(inner);
  if (!line) return std::nullopt;
  const double n = static_cast<double>(inner.size()), rms = rmsDistance(inner, *line);
  const TPoint2D a = projected(inner.front(), line->rho, line->theta),
                 b = projected(inner.back(), line->rho, line->theta);
  return WallPiece{piece,          inner,        *line, n * rms * rms, atLeast(n * rms * rms, n - 2),
                   (b - a).norm(), (a + b) * 0.5};
}

/// Variance of the line perpendicular to it, at a point on it: sigma^2 / n (1 + 12 d^2 / l^2), with d from
/// the middle.
double varianceAt(const WallPiece& wall, const TPoint2D& point) {
  const double d = (point - wall.middle).norm() / wall.length;
  return wall.variance / static_cast<double>(wall.inner.size()) * (1 + 12 * d * d);
}

double angleVariance(const WallPiece& wall) {
  return 12 * wall.variance / (static_cast<double>(wall.inner.size()) * wall.length * wall.length);
}

bool isClear(const WallPiece& wall, double minWall, double maxRms) {
  return wall.length >= minWall && wall.squares <= static_cast<double>(wall.inner.size()) * maxRms * maxRms;
}

std::optional<PointFeature> cornerOf(const WallPiece& a, const WallPiece& b, double minWall, double maxRms) {
  if (a.piece.last - 1 != b.piece.first || !isClear(a, minWall, maxRms) || !isClear(b, minWall, maxRms))
    return std::nullopt;
  const double sine = std::sin(b.line.theta - a.line.theta);
  const double certain = kClear * std::sqrt(angleVariance(a) + angleVariance(b));
  if (std::abs(sine) < std::max(kSharpest, std::sin(std::min(certain, M_PI / 2)))) return std::nullopt;
  Eigen::Matrix2d normals;
  normals << std::cos(a.line.theta), std::sin(a.line.theta), std::cos(b.line.theta), std::sin(b.line.theta);
  const Eigen::Matrix2d inverse = normals.inverse();
  const Eigen::Vector2d at = inverse * Eigen::Vector2d(a.line.rho, b.line.rho);

  PointFeature corner;
  corner.position = {at.x(), at.y()};
  // The corner may not be farther from its beam than the beam's neighbours are.
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

/// Returns whether no beam without a reading lies between the points `a` and `b`: the angle between them is
/// not larger than that to the beam `c` on the other side of `b`.
bool isNeighbour(const TPoint2D& a, const TPoint2D& b, const TPoint2D& c) {
  const auto angle = [](const TPoint2D& p, const TPoint2D& q) {
    return std::abs(std::atan2(p.x * q.y - p.y * q.x, p.x * q.x + p.y * q.y));
  };
  return angle(a, b) < 1.5 * angle(b, c);
}

/// The end of a wall beyond which the laser sees farther than the wall's line, as at an opening or a corner
/// whose other wall shows too few points: between the last beam on the wall and the next one.
/// @param all     the scan's points
/// @param isLast  the end in beam order, or the start
std::optional<PointFeature> wallEndOf(const WallPiece& wall, bool isLast, PointRange all, double minWall,
                                      double maxRms) {
  if (!isClear(wall, minWall, maxRms)) return std::nullopt;
  const std::ptrdiff_t step = isLast ? 1 : -1;
  const TPoint2D* const edge = isLast ? wall.piece.last - 1 : wall.piece.first;
  const TPoint2D* const next = edge + step;
  if (next < all.first || next >= all.last || !isNeighbour(*next, *edge, *(edge - step))) return std::nullopt;
  const TPoint2D from =
      projected(isLast ? wall.inner.back() : wall.inner.front(), wall.line.rho, wall.line.theta);
  // `to` is where the next beam would have met the wall.
  const TPoint2D beam = next->unitarize();
  const double facing = beam.x * std::cos(wall.line.theta) + beam.y * std::sin(wall.line.theta);
  const TPoint2D to = beam * (wall.line.rho / facing);
  const double spacing = (to - from).norm();
  if (facing <= 0 || !(spacing > 0 && spacing < kMostSpacing) ||
      next->norm() < to.norm() + kSplitDistance + kClear * std::sqrt(wall.variance))
    return std::nullopt;

  PointFeature end;
  end.kind = FeatureKind::wallEnd;
  end.position = (from + to) * 0.5;
  const Eigen::Rotation2Dd turn(wall.line.theta);  // x across the wall
  end.covariance = turn.toRotationMatrix() *
                   Eigen::Vector2d(varianceAt(wall, end.position), spacing * spacing / 12).asDiagonal() *
                   turn.inverse().toRotationMatrix();
  end.covariance(1, 0) = end.covariance(0, 1);  // rounding
  const TPoint2D inwards = wall.middle - end.position;
  end.direction = std::atan2(inwards.y, inwards.x);
  return end;
}

struct Arc {
  PointFeature feature;
  double variance;  ///< of a point's distance from it, m^2
};

/// Returns the arc of a run; empty if its variance is not less than `variance`.
std::optional<Arc> arcOf(PointRange run, double variance, double maxRms) {
  if (run.size() < kLeastArcPoints) return std::nullopt;
  const auto circle = fitCircle(run);
  const double n = static_cast<double>(run.size());
  if (!circle || circle->radius < kLeastRadius || circle->squares > n * maxRms * maxRms) return std::nullopt;
  const double own = atLeast(circle->squares, n - 3);
  if (own >= variance) return std::nullopt;
  PointFeature arc;
  arc.position = circle->centre;
  arc.covariance = own * circle->cofactor.topLeftCorner<2, 2>();
  arc.radius = circle->radius;
  arc.radiusVariance = own * circle->cofactor(2, 2);
  const double toCentre = arc.position.norm();
  arc.kind = toCentre > arc.radius ? FeatureKind::pillar : FeatureKind::hall;
  // The near side of a pillar bulges; the far side of a ring around a pillar does not.
  const bool bulges = run.first[run.size() / 2].norm() < toCentre;
  if (bulges != (arc.kind == FeatureKind::pillar)) arc.kind = FeatureKind::hall;
  return Arc{arc, own};
}

bool isRound(const PointFeature& arc) {
  return arc.radiusVariance < std::pow(kCertainRadius * arc.radius, 2);
}

bool isCertain(const PointFeature& feature) {
  return feature.covariance.allFinite() && feature.covariance.determinant() > 0 &&
         feature.covariance.trace() < kMostDeviation * kMostDeviation;
}

}  // namespace

std::vector<PointFeature> detectFeatures(const LaserScan& scan, const LineExtractionOptions& lines,
                                         const FeatureOptions& options) {
  SegmentationOptions everyPoint = lines.segmentation, straight = lines.segmentation;
  everyPoint.minPoints = 1;
  everyPoint.gapRelative = std::min(everyPoint.gapRelative, kGapRelative);
  straight.minPoints = kLeastPoints;
  straight.splitDistance = kSplitDistance;
  std::vector<PointFeature> features;
  const auto add = [&](const std::optional<PointFeature>& feature) {
    if (feature && isCertain(*feature)) features.push_back(transformed(*feature, scan.sensorPose));
  };
  const SegmentedScan segmented(scan, everyPoint);
  const std::vector<PointRange> runs = segmented.runs();
  if (runs.empty()) return features;
  const PointRange all{runs.front().first, runs.back().last};
  for (const PointRange& run : runs) {
    if (run.size() < kLeastPoints) continue;
    std::vector<PointRange> pieces;
    splitAtCorners(run, straight, pieces);
    std::vector<WallPiece> walls;
    double squares = 0, freedom = 0;
    for (const PointRange& piece : pieces)
      if (const auto wall = wallOf(piece, run)) {
        walls.push_back(*wall);
        squares += wall->squares;
        freedom += static_cast<double>(wall->inner.size()) - 2;
      }
    for (WallPiece& wall : walls) wall.variance = std::max(wall.variance, atLeast(squares, freedom));
    const double variance = walls.empty() ? lines.fit.maxRms * lines.fit.maxRms : atLeast(squares, freedom);
    const auto arc = arcOf(run, kSimilar * variance, lines.fit.maxRms);
    const bool isArc = arc && arc->variance < variance && isRound(arc->feature);
    if (isArc && arc->feature.radius <= options.maxRadius) add(arc->feature);
    // A round object with few points may look like several walls; it then gives neither a centre nor corners.
    if (isArc || (arc && walls.size() > 1)) continue;
    bool startsAtCorner = false;
    for (size_t i = 0; i < walls.size(); ++i) {
      std::optional<PointFeature> corner;
      if (i + 1 < walls.size()) corner = cornerOf(walls[i], walls[i + 1], options.minWall, lines.fit.maxRms);
      if (options.wallEnds) {
        if (!startsAtCorner) add(wallEndOf(walls[i], false, all, options.minWall, lines.fit.maxRms));
        if (!corner) add(wallEndOf(walls[i], true, all, options.minWall, lines.fit.maxRms));
      }
      add(corner);
      startsAtCorner = corner.has_value();
    }
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
