#include "slam/lines/LineFit.h"

#include <cmath>
#include <limits>

#include "slam/lines/LineSegment.h"

namespace hybrid_slam {

using mrpt::math::TPoint2D;

void LineFitOptions::describe(OptionTable& table) {
  table.add("method", method, {{Method::orthogonal, "orthogonal"}, {Method::paper, "paper"}},
            "orthogonal: least squares of the orthogonal distances; paper: eq. (2)-(5) (less accurate: "
            "doc/paper-notes.md)");
  table.add("max_rms", maxRms, 0, 10, "m",
            "method orthogonal, and regression: largest RMS distance of a segment's points from the line");
  table.add("max_error", maxError, 0, 1e6, "m^2", "method paper: largest error, eq. (5), of a segment");
}

namespace {

/// @param weightOf  weight of the point of an index
template <class Weight>
std::optional<FittedLine> fitWeighted(PointRange points, const Weight& weightOf) {
  double sum = 0, meanX = 0, meanY = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    sum += weightOf(i);
    meanX += weightOf(i) * points.first[i].x;
    meanY += weightOf(i) * points.first[i].y;
  }
  meanX /= sum;
  meanY /= sum;
  double xx = 0, xy = 0, yy = 0;  // about the mean, to avoid cancellation far from the origin
  for (size_t i = 0; i < points.size(); ++i) {
    const double x = points.first[i].x - meanX, y = points.first[i].y - meanY;
    xx += weightOf(i) * x * x;
    xy += weightOf(i) * x * y;
    yy += weightOf(i) * y * y;
  }
  if (!(xx + yy > 0)) return std::nullopt;
  FittedLine line;
  line.theta = 0.5 * std::atan2(2 * xy, xx - yy) + M_PI / 2;  // the axis of least inertia, then its normal
  line.rho = signedDistance({meanX, meanY}, 0, line.theta);
  normalise(line.rho, line.theta);
  return line;
}

}  // namespace

std::optional<FittedLine> fitOrthogonal(PointRange points) {
  return fitWeighted(points, [](size_t) { return 1.0; });
}

std::optional<FittedLine> fitOrthogonal(PointRange points, const std::vector<double>& weights) {
  return fitWeighted(points, [&weights](size_t i) { return weights[i]; });
}

double rmsDistance(PointRange points, const FittedLine& line) {
  const double c = std::cos(line.theta), s = std::sin(line.theta);
  double sum = 0;
  for (const TPoint2D& p : points) {
    const double distance = p.x * c + p.y * s - line.rho;
    sum += distance * distance;
  }
  return std::sqrt(sum / static_cast<double>(points.size()));
}

// eq. (2)-(4): a, b, c of a x + b y + c = 0.
LineCoefficients fitCoefficients(PointRange points) {
  double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  for (const TPoint2D& p : points) {
    x += p.x;
    y += p.y;
    xx += p.x * p.x;
    xy += p.x * p.y;
    yy += p.y * p.y;
  }
  return {x * yy - y * xy, y * xx - x * xy, xy * xy - xx * yy};
}

// eq. (5): the sum of the squared residuals along y.
double verticalError(PointRange points, const LineCoefficients& line) {
  if (line.b == 0) return std::numeric_limits<double>::infinity();
  double sum = 0;
  for (const TPoint2D& p : points) {
    const double residual = -line.a / line.b * p.x - line.c / line.b - p.y;
    sum += residual * residual;
  }
  return sum;
}

// eq. (6), with the signs that doc/paper-notes.md derives: rho and theta of a x + b y + c = 0.
std::optional<FittedLine> toHesse(const LineCoefficients& line) {
  const double norm = std::hypot(line.a, line.b);
  if (norm <= 0) return std::nullopt;
  FittedLine result{-line.c / norm, std::atan2(line.b, line.a)};
  normalise(result.rho, result.theta);
  return result;
}

std::optional<FittedLine> fitLine(PointRange points, const LineFitOptions& options) {
  if (options.method == LineFitOptions::Method::paper) {
    const LineCoefficients line = fitCoefficients(points);
    if (verticalError(points, line) > options.maxError) return std::nullopt;
    return toHesse(line);
  }
  const auto line = fitOrthogonal(points);
  if (!line || rmsDistance(points, *line) > options.maxRms) return std::nullopt;
  return line;
}

}  // namespace hybrid_slam
