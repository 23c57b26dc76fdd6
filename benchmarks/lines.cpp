/// @file lines.cpp
/// @brief Compares the methods of line extraction, as rows of Markdown tables (scripts/line-extraction.sh).
///
///     hybrid-slam-lines plan PLAN SEED TRAJECTORY...
///     hybrid-slam-lines log LOG NAME
///
/// `plan` simulates an LMS-100 at every fourth pose of the trajectories (TUM) and compares the lines of its
/// scans with the walls that its beams hit. `log` compares the lines of neighbouring scans of a log, 0.3 m or
/// 10 deg apart by odometry, and subtracts what an error of the odometry explains.
#include <mrpt/obs/CObservation2DRangeScan.h>

#include <cstdio>
#include <ctime>
#include <iostream>

#include "Counterparts.h"
#include "Sigma.h"
#include "TrueLines.h"
#include "base/Errors.h"
#include "files/Trajectory.h"
#include "readings/RawlogSource.h"
#include "run/LogSettings.h"
#include "study/simulation/Laser.h"
#include "study/simulation/NoiseStream.h"

namespace hybrid_slam::bench {
namespace {

/// CPU time of this thread, s: other programs hardly change it.
double threadSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

using Lines = std::vector<LineSegment>;

/// Returns the lines of all scans, and the scans per second.
std::pair<std::vector<Lines>, double> extractAll(const std::vector<LaserScan>& scans,
                                                 const LineExtractionOptions& options) {
  std::vector<Lines> lines;
  lines.reserve(scans.size());
  const double start = threadSeconds();
  for (const LaserScan& scan : scans) lines.push_back(extractLines(scan, options));
  return {lines, static_cast<double>(scans.size()) / (threadSeconds() - start)};
}

void comparePlan(const std::string& planFile, const std::string& seed,
                 const std::vector<std::string>& trajectories) {
  const auto plan = simulation::BuildingPlan::load(planFile);
  const simulation::Laser laser{simulation::LaserOptions()};
  std::vector<TPose2D> poses;
  for (const std::string& file : trajectories) {
    const auto trajectory = files::loadTum(file);
    for (size_t i = 0; i < trajectory.size(); i += 4) poses.push_back(trajectory[i].pose);
  }
  std::vector<LaserScan> scans;
  std::vector<std::vector<TrueLine>> truth;
  for (const TPose2D& pose : poses) {
    auto random = simulation::noiseStream(std::stoul(seed), 1, simulation::NoiseSource::laser, scans.size());
    scans.push_back(toLaserScan(laser.scan(plan, pose, random), 20));
    truth.push_back(trueLines(plan, scans.back(), pose));
  }
  LineExtractionOptions options;
  for (const LineExtractor* method : lineExtractors()) {
    options.method = method;
    const auto [lines, rate] = extractAll(scans, options);
    Agreement sum;
    size_t count = 0;
    for (size_t i = 0; i < scans.size(); ++i) {
      sum.add(transformed(lines[i], poses[i]), truth[i], options.segmentation.minLength,
              static_cast<size_t>(options.segmentation.minPoints));
      count += lines[i].size();
    }
    const Sigma angle = sigmaOf(sum.angles), distance = sigmaOf(sum.distances);
    std::printf("| `%s` | %.0f | %.2f | %.1f | %.1f | %.3f (%.3f) | %.2f (%.2f) |\n", method->name, rate,
                static_cast<double>(count) / static_cast<double>(scans.size()),
                100 * static_cast<double>(sum.found) / static_cast<double>(sum.trueLines),
                100 * static_cast<double>(sum.wrong) / static_cast<double>(sum.found + sum.wrong),
                mrpt::RAD2DEG(angle.robust), mrpt::RAD2DEG(angle.rms), 1000 * distance.robust,
                1000 * distance.rms);
  }
}

void compareLog(const std::string& file, const std::string& name) {
  run::Configuration configuration;
  const auto summary = readings::summarise(file, configuration.input);
  run::applyLogSettings(run::readLogSettings(file, configuration.input, summary), configuration);
  readings::RawlogSource source(file, configuration.input, summary);
  std::vector<LaserScan> scans;
  std::vector<TPose2D> motions;
  while (const auto reading = source.next()) {
    scans.push_back(toLaserScan(*reading->scans.back(), configuration.filter.grid.maxRange));
    motions.push_back(reading->motion);
  }
  LineExtractionOptions options;
  for (const LineExtractor* method : lineExtractors()) {
    options.method = method;
    const auto [lines, rate] = extractAll(scans, options);
    size_t count = 0, again = 0, compared = 0, last = 0;
    Differences differences;
    TPose2D motion;
    for (size_t i = 0; i < scans.size(); ++i) {
      count += lines[i].size();
      if (i > 0) motion = motion + motions[i];
      if (i == 0 || (motion.norm() < 0.3 && std::abs(motion.phi) < mrpt::DEG2RAD(10.0))) continue;
      const auto pairs = counterparts(lines[last], lines[i], motion);
      compared += lines[i].size();
      again += pairs.size();
      differences.add(pairs);
      motion = {};
      last = i;
    }
    // Two lines differ by sqrt(2) times the error of one.
    const Sigma angle = sigmaOf(differences.angles), distance = sigmaOf(differences.distances);
    const double degrees = mrpt::RAD2DEG(1 / std::sqrt(2)), millimetres = 1000 / std::sqrt(2);
    std::printf("| %s | `%s` | %.0f | %.2f | %.1f | %.3f (%.3f) | %.1f (%.1f) |\n", name.c_str(),
                method->name, rate, static_cast<double>(count) / static_cast<double>(scans.size()),
                100 * static_cast<double>(again) / static_cast<double>(compared), degrees * angle.robust,
                degrees * angle.rms, millimetres * distance.robust, millimetres * distance.rms);
  }
}

}  // namespace
}  // namespace hybrid_slam::bench

int main(int argc, char** argv) {
  using namespace hybrid_slam;
  const std::vector<std::string> words(argv + 1, argv + argc);
  try {
    if (words.size() >= 4 && words[0] == "plan")
      bench::comparePlan(words[1], words[2], {words.begin() + 3, words.end()});
    else if (words.size() == 3 && words[0] == "log")
      bench::compareLog(words[1], words[2]);
    else
      throw InputError("unknown arguments", "the command line",
                       "expected plan PLAN SEED TRAJECTORY... or log LOG NAME");
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << '\n';
    return 2;
  }
}
