#include "study/comparison/ParticlePlot.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "base/Numbers.h"
#include "files/LineReader.h"
#include "study/comparison/PlanPlots.h"
#include "study/comparison/ReportText.h"
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
  if (std::error_code none; !std::filesystem::exists(file, none)) return {};
  files::LineReader in(file);
  std::string line;
  in.next(line);
  while (in.next(line)) {
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

namespace {

/// Distance of the ticks (m): 1, 2 or 5 times a power of ten, so that there are at most four labels side by
/// side.
double ticStep(double side) {
  for (double power = std::pow(10, std::floor(std::log10(side / 4)));; power *= 10)
    for (const double factor : {1, 2, 5})
      if (factor * power >= side / 4) return factor * power;
}

}  // namespace

Plot plotParticles(const ParticleSnapshot& snapshot, const TPose2D& alignment,
                   const simulation::BuildingPlan* plan, double side, const std::string& title) {
  constexpr size_t kParticles = 200;
  const TPose2D robot = alignment + snapshot.best();
  const TPoint2D half(side / 2, side / 2), low = TPoint2D(robot.x, robot.y) - half, high = low + half + half;
  DataBlock best("robot"), particles("particles");
  best.add({robot.x, robot.y});
  const size_t every = (snapshot.particles.size() + kParticles - 1) / kParticles;
  const double heading = 0.05 * side;  // m, as long as it is drawn
  for (size_t i = 0; i < snapshot.particles.size(); i += every) {
    const TPose2D pose = alignment + snapshot.particles[i].pose;
    if (std::abs(pose.x - robot.x) > half.x || std::abs(pose.y - robot.y) > half.y) continue;
    particles.add({pose.x, pose.y, heading * std::cos(pose.phi), heading * std::sin(pose.phi)});
  }
  return {"particles of " + title, 264, 288,
          planFrame(title, low, high) + "set tics " + shortNumber(ticStep(side)) + "\n" +
              (plan ? wallBlock(*plan) : "") + best.script() + particles.script() + "plot " +
              (plan ? "$walls with lines linewidth 2 linecolor rgb 'black' notitle, " : "") +
              "$robot with points pointtype 7 pointsize 1.6 linecolor rgb '#56b4e9' notitle, "
              "$particles with vectors nohead linecolor rgb '#66d00000' notitle, "
              "$particles with points pointtype 7 pointsize 0.4 linecolor rgb '#d00000' notitle\n"};
}

}  // namespace hybrid_slam::comparison
