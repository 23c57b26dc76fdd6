#include "study/comparison/ParticlePlot.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "base/Numbers.h"
#include "study/comparison/PlanView.h"
#include "study/comparison/TableLine.h"

namespace hybrid_slam::comparison {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

const TPose2D& ParticleSnapshot::best() const {
  return std::max_element(particles.begin(), particles.end(),
                          [](const auto& a, const auto& b) { return a.logWeight < b.logWeight; })
      ->pose;
}

double ParticleSnapshot::radius() const {
  double farthest = 0;
  for (const WeightedParticle& p : particles)
    farthest = std::max(farthest, std::hypot(p.pose.x - best().x, p.pose.y - best().y));
  return farthest;
}

std::vector<ParticleSnapshot> loadParticles(const std::string& file) {
  std::vector<ParticleSnapshot> run;
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    const std::vector<std::string> fields = splitAtCommas(line);
    std::array<double, 5> row{};
    for (size_t i = 0; i < row.size(); ++i) {
      const auto number = i < fields.size() ? parseNumber(fields[i]) : std::nullopt;
      if (!number) throw std::runtime_error("broken table: " + file);
      row[i] = *number;
    }
    if (run.empty() || run.back().timestamp != row[0]) run.push_back({row[0], {}});
    run.back().particles.push_back({{row[1], row[2], row[3]}, row[4]});
  }
  return run;
}

std::vector<double> turningMoments(const std::vector<ParticleSnapshot>& run, size_t count) {
  std::vector<double> moments;
  for (size_t part = 0; part < count; ++part) {
    const size_t from = std::max<size_t>(1, part * run.size() / count), to = (part + 1) * run.size() / count;
    double most = -1, moment = 0;
    for (size_t i = from; i < to; ++i) {
      const double turn = std::abs(mrpt::math::wrapToPi(run[i].best().phi - run[i - 1].best().phi));
      if (turn > most) most = turn, moment = run[i].timestamp;
    }
    if (most >= 0) moments.push_back(moment);
  }
  return moments;
}

const ParticleSnapshot& nearestSnapshot(const std::vector<ParticleSnapshot>& run, double timestamp) {
  return *std::min_element(run.begin(), run.end(), [timestamp](const auto& a, const auto& b) {
    return std::abs(a.timestamp - timestamp) < std::abs(b.timestamp - timestamp);
  });
}

std::string plotParticles(const ParticleSnapshot& snapshot, const TPose2D& alignment,
                          const simulation::FloorPlan* plan, double side, const std::string& title) {
  constexpr double kPixels = 250, kTop = 24;
  const double scale = kPixels / side;
  const TPose2D robot = alignment + snapshot.best();
  Svg svg(kPixels, kTop + kPixels + 22);
  svg.text({0, 15}, title, Anchor::start, "font-weight:bold");
  const PlanView view({robot.x - side / 2, robot.y + side / 2}, {0, kTop}, scale);
  const auto isInside = [&](const Point& p) {
    return p.x >= 0 && p.x <= kPixels && p.y >= kTop && p.y <= kTop + kPixels;
  };
  svg.rectangle({0, kTop}, kPixels, kPixels, "fill:#fff;stroke:#bbb;stroke-width:1");
  if (plan)
    for (const simulation::Wall& wall : plan->walls()) {
      const double step = 0.02;  // m; only the steps inside of the square are drawn
      const int pieces = static_cast<int>(std::ceil(wall.length() / step));
      std::vector<Point> points;
      for (int i = 0; i <= pieces; ++i) {
        const Point p = view.pixel(wall.pointAt(static_cast<double>(i) / pieces));
        if (isInside(p)) points.push_back(p);
        if ((!isInside(p) || i == pieces) && !points.empty()) {
          svg.polyline(points, "stroke:#000;stroke-width:2");
          points.clear();
        }
      }
    }
  svg.circle(view.pixel({robot.x, robot.y}), 9,
             "fill:#56b4e9;fill-opacity:0.6;stroke:#0072b2;stroke-width:1");
  for (const WeightedParticle& particle : snapshot.particles) {
    const TPose2D pose = alignment + particle.pose;
    const Point at = view.pixel({pose.x, pose.y});
    if (!isInside(at)) continue;
    svg.line(at, {at.x + 14 * std::cos(pose.phi), at.y - 14 * std::sin(pose.phi)},
             "stroke:#d00000;stroke-width:0.8;stroke-opacity:0.6");
    svg.circle(at, 2.2, "fill:#d00000");
  }
  view.drawScaleBar(svg, {0, kTop + kPixels + 12}, kPixels / 2);
  return svg.str("particles of " + title);
}

}  // namespace hybrid_slam::comparison
