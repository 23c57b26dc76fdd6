#include "slam/filter/LineMapWeight.h"

#include <algorithm>
#include <cmath>

namespace hybrid_slam {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

void LineMapOptions::describe(OptionTable& t) {
  t.add("min_length", minLength, 0, 100, "m",
        "minimum length of a new line, instead of [line_database] min_length: lines are the whole map");
  t.add("beams", beams, 0, 10000, "number of beams weighted, evenly over the wall directions; 0: all");
  t.add("sigma", sigma, 0.005, 2, "m", "standard deviation of a beam's end point relative to its line");
  t.add("in_front", inFront, 0, 0.49, "", "fraction of readings in front of the line (clutter, people)");
  t.add("random", random, 1e-6, 0.5, "",
        "fraction of readings anywhere, also behind the line (doors, glass)");
  t.add("exponent", exponent, 0, 1000, "",
        "weight = (geometric mean of the beam likelihoods)^exponent: the effective number of independent "
        "beams");
}

std::vector<ExpectedWall> expectedWalls(const ScanBeams& beams, const TPose2D& robot,
                                        const std::vector<DatabaseLine>& lines, double reach) {
  std::vector<ExpectedWall> walls(beams.rays.size());
  const TPose2D toRobot = TPose2D() - robot;
  for (const DatabaseLine& line : lines) {
    // The line's distance first: most lines of a building are out of reach.
    if (std::abs(signedDistance({robot.x, robot.y}, line.rho, line.theta)) > reach) continue;
    const TPoint2D middle((line.start.x + line.end.x) / 2, (line.start.y + line.end.y) / 2);
    if (std::hypot(middle.x - robot.x, middle.y - robot.y) > reach + line.length / 2) continue;

    const TPoint2D start = toRobot.composePoint(line.start), end = toRobot.composePoint(line.end);
    const double alongX = end.x - start.x, alongY = end.y - start.y;
    for (size_t i = 0; i < walls.size(); ++i) {
      const ScanBeams::Ray& ray = beams.rays[i];
      const TPoint2D& origin = beams.origins[ray.laser];
      const double cross = ray.dirX * alongY - ray.dirY * alongX;
      const double x = start.x - origin.x, y = start.y - origin.y;
      const double range = x * alongY - y * alongX, place = x * ray.dirY - y * ray.dirX;  // x cross
      const double sign = cross < 0 ? -1 : 1, size = std::abs(cross);
      if (sign * range <= 0 || sign * place < 0 || sign * place > size) continue;
      if (sign * range < walls[i].range * size) walls[i] = {sign * range / size, size / line.length};
    }
  }
  return walls;
}

LineMapWeight::LineMapWeight(const LineMapOptions& o, double maxRange)
    : maxRange_(maxRange), information_(1 / (o.sigma * o.sigma)), hit_(1 - o.inFront - o.random) {
  const double scale = o.sigma * std::sqrt(2 * M_PI);
  inFront_ = scale * o.inFront;
  unknown_ = scale / maxRange;
  random_ = unknown_ * o.random;
}

double LineMapWeight::meanLogLikelihood(const ScanBeams& beams, const TPose2D& robot,
                                        const LineDatabase& lines) const {
  if (beams.rays.empty()) return 0;
  const std::vector<ExpectedWall> walls = expectedWalls(beams, robot, lines.lines(), maxRange_);
  double sum = 0;
  for (size_t i = 0; i < walls.size(); ++i) {
    const double beyond = beams.rays[i].range - walls[i].range;
    if (std::isinf(beyond)) {
      sum += std::log(std::min(unknown_, 1.0));
      continue;
    }
    const double distance = beyond * walls[i].sine;
    const double hit = hit_ * std::exp(-0.5 * distance * distance * information_);
    const double inFront = beyond < 0 ? inFront_ / walls[i].range : 0;
    sum += std::log(std::min(hit + inFront + random_, 1.0));
  }
  return sum / static_cast<double>(walls.size());
}

}  // namespace hybrid_slam
