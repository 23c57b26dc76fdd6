#include "slam/lines/LineSegment.h"

#include <mrpt/math/TPose2D.h>

#include <cmath>

namespace hybrid_slam {

using mrpt::math::TPoint2D;

void normalise(double& rho, double& theta) {
  if (rho < 0) {
    rho = -rho;
    theta += M_PI;
  }
  theta = std::remainder(theta, 2 * M_PI);
  if (theta <= -M_PI) theta = M_PI;
}

double signedDistance(const TPoint2D& point, double rho, double theta) {
  return point.x * std::cos(theta) + point.y * std::sin(theta) - rho;
}

TPoint2D projected(const TPoint2D& point, double rho, double theta) {
  const double distance = signedDistance(point, rho, theta);
  return {point.x - distance * std::cos(theta), point.y - distance * std::sin(theta)};
}

TPoint2D middle(const LineSegment& segment) {
  return {0.5 * (segment.start.x + segment.end.x), 0.5 * (segment.start.y + segment.end.y)};
}

LineSegment makeSegment(const TPoint2D& start, const TPoint2D& end) {
  LineSegment segment;
  segment.start = start;
  segment.end = end;
  segment.length = std::hypot(end.x - start.x, end.y - start.y);
  segment.theta = std::atan2(end.y - start.y, end.x - start.x) + M_PI / 2;
  segment.rho = signedDistance(middle(segment), 0, segment.theta);
  normalise(segment.rho, segment.theta);
  return segment;
}

LineSegment makeSegment(double rho, double theta, const TPoint2D& start, const TPoint2D& end) {
  normalise(rho, theta);
  LineSegment segment;
  segment.rho = rho;
  segment.theta = theta;
  segment.start = projected(start, rho, theta);
  segment.end = projected(end, rho, theta);
  segment.length = std::hypot(segment.end.x - segment.start.x, segment.end.y - segment.start.y);
  return segment;
}

LineSegment transformed(const LineSegment& segment, const mrpt::math::TPose2D& frame) {
  LineSegment result;
  result.theta = segment.theta + frame.phi;
  result.rho = segment.rho + frame.x * std::cos(result.theta) + frame.y * std::sin(result.theta);
  normalise(result.rho, result.theta);
  result.length = segment.length;
  result.start = frame.composePoint(segment.start);
  result.end = frame.composePoint(segment.end);
  return result;
}

std::vector<LineSegment> transformed(std::vector<LineSegment> segments, const mrpt::math::TPose2D& frame) {
  for (LineSegment& segment : segments) segment = transformed(segment, frame);
  return segments;
}

}  // namespace hybrid_slam
