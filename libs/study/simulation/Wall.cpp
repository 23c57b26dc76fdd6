#include "study/simulation/Wall.h"

#include <algorithm>
#include <cmath>

#include "base/Segments.h"

namespace hybrid_slam::simulation {

using mrpt::math::TPoint2D;

namespace {

/// Tolerance, so that rays do not slip through the joint of two walls by rounding.
constexpr double kSlack = 1e-9;  // m

double cross(const TPoint2D& a, const TPoint2D& b) { return a.x * b.y - a.y * b.x; }
double dot(const TPoint2D& a, const TPoint2D& b) { return a.x * b.x + a.y * b.y; }

double rayToSegment(const Wall& wall, const TPoint2D& origin, const TPoint2D& direction) {
  const TPoint2D along = wall.end - wall.start, toStart = wall.start - origin;
  const double length = along.norm(), sine = cross(direction, along) / length;
  if (std::abs(sine) < 1e-12) {  // parallel
    if (std::abs(cross(direction, toStart)) > kSlack) return kNoHit;
    const double a = dot(direction, toStart), b = dot(direction, wall.end - origin);
    if (std::max(a, b) < 0) return kNoHit;
    return std::max(0.0, std::min(a, b));
  }
  const double t = cross(toStart, along) / (sine * length);
  const double s = cross(toStart, direction) / sine;  // m from the wall's start
  return t >= 0 && s >= -kSlack && s <= length + kSlack ? t : kNoHit;
}

/// Returns whether an angle lies within the arc, with kSlack of length at both ends.
bool onArc(const Wall& wall, double angle) {
  double turned = std::fmod(angle - wall.startAngle, 2 * M_PI);
  if (turned < 0) turned += 2 * M_PI;
  const double slack = kSlack / wall.radius;
  return turned <= wall.sweep + slack || turned >= 2 * M_PI - slack;
}

double rayToArc(const Wall& wall, const TPoint2D& origin, const TPoint2D& direction) {
  const TPoint2D fromCentre = origin - wall.centre;
  const double half = dot(fromCentre, direction), offset = cross(direction, fromCentre);
  const double root = (wall.radius - offset) * (wall.radius + offset);
  if (root < 0) return kNoHit;
  for (const double t : {-half - std::sqrt(root), -half + std::sqrt(root)}) {
    const TPoint2D p = fromCentre + direction * t;
    if (t >= 0 && onArc(wall, std::atan2(p.y, p.x))) return t;
  }
  return kNoHit;
}

}  // namespace

Wall Wall::straight(const TPoint2D& start, const TPoint2D& end) {
  Wall wall;
  wall.start = start;
  wall.end = end;
  return wall;
}

Wall Wall::arc(const TPoint2D& centre, double radius, double startAngle, double sweep) {
  Wall wall;
  wall.centre = centre;
  wall.radius = radius;
  wall.startAngle = startAngle;
  wall.sweep = sweep;
  wall.start = wall.pointAt(0);
  wall.end = wall.pointAt(1);
  return wall;
}

double Wall::length() const { return isArc() ? radius * sweep : (end - start).norm(); }

TPoint2D Wall::pointAt(double fraction) const {
  if (!isArc()) return start + (end - start) * fraction;
  const double angle = startAngle + fraction * sweep;
  return {centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)};
}

double Wall::distance(const TPoint2D& p) const {
  if (isArc()) {
    const TPoint2D fromCentre = p - centre;
    if (onArc(*this, std::atan2(fromCentre.y, fromCentre.x))) return std::abs(fromCentre.norm() - radius);
    return std::min((p - start).norm(), (p - end).norm());
  }
  return (p - nearestOnSegment(p, start, end)).norm();
}

double rayDistance(const Wall& wall, const TPoint2D& origin, const TPoint2D& direction) {
  return wall.isArc() ? rayToArc(wall, origin, direction) : rayToSegment(wall, origin, direction);
}

}  // namespace hybrid_slam::simulation
