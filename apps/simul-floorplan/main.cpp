/// @file main.cpp
/// @brief simul-floorplan: simulates a robot and its sensors in a floor plan; writes a rawlog and ground
/// truth.
#include <mrpt/config/CConfigFileMemory.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "Program.h"
#include "study/simulation/FloorPlan.h"
#include "study/simulation/Route.h"
#include "study/simulation/SimulationOutput.h"

namespace {

using namespace hybrid_slam;
namespace fs = std::filesystem;

struct CommandLine {
  std::string config, output;
  int seed = -1;
  std::vector<std::string> settings;
  bool quiet = false;
};

mrpt::config::CConfigFileMemory readConfig(const CommandLine& line) {
  std::ifstream in(line.config);
  if (!in || !fs::is_regular_file(line.config))
    throw InputError("cannot be read", "file " + line.config, "expected an INI file");
  mrpt::config::CConfigFileMemory config(std::string(std::istreambuf_iterator<char>(in), {}));
  for (const std::string& setting : line.settings) {
    const auto equals = setting.find('='), dot = setting.find('.');
    if (equals == std::string::npos || dot == std::string::npos || dot > equals)
      throw InputError("wrong setting `" + setting + "`", "option --set", "expected SECTION.KEY=VALUE");
    config.write(setting.substr(0, dot), setting.substr(dot + 1, equals - dot - 1),
                 setting.substr(equals + 1));
  }
  if (line.seed >= 0) config.write("simulation", "seed", line.seed);
  return config;
}

void checkSections(const mrpt::config::CConfigFileBase& config, const std::vector<std::string>& known) {
  std::vector<std::string> sections;
  config.getAllSections(sections);
  for (const std::string& section : sections)
    if (std::find(known.begin(), known.end(), section) == known.end())
      throw InputError("unknown section", "section [" + section + "]",
                       "the nearest known section is [" + nearestName(section, known) + "]");
}

std::string besideConfig(const CommandLine& line, const std::string& file, const char* key) {
  if (file.empty())
    throw InputError("missing key", std::string("section [simulation], key `") + key + "`",
                     "expected a file name");
  return (fs::path(line.config).parent_path() / file).lexically_normal().string();
}

/// Writes all files under temporary names first, so that no half-written file has a final name.
void writeTogether(
    const std::vector<std::pair<fs::path, std::function<void(const std::string&)>>>& filesAndWriters) {
  const auto partial = [](fs::path file) {
    return file.replace_extension(".part" + file.extension().string());
  };
  try {
    for (const auto& [file, write] : filesAndWriters) write(partial(file).string());
    for (const auto& [file, write] : filesAndWriters) fs::rename(partial(file), file);
  } catch (...) {
    std::error_code ignored;
    for (const auto& [file, write] : filesAndWriters) fs::remove(partial(file), ignored);
    throw;
  }
}

void run(const CommandLine& line) {
  const mrpt::config::CConfigFileMemory config = readConfig(line);
  simulation::SimulationOptions options;
  simulation::LaserOptions laser;
  simulation::OdometryOptions odometry;
  checkSections(config, {"simulation", "laser", "odometry"});
  options.loadFromConfigFile(config, "simulation");
  laser.loadFromConfigFile(config, "laser");
  odometry.loadFromConfigFile(config, "odometry");
  const fs::path output = line.output;
  if (output.extension() != ".rawlog")
    throw InputError("wrong output name `" + line.output + "`", "option -o",
                     "expected a name ending in .rawlog");
  if (output.has_parent_path() && !fs::is_directory(output.parent_path()))
    throw InputError("no such folder", "folder " + output.parent_path().string(),
                     "expected an existing folder");

  const simulation::FloorPlan plan = simulation::FloorPlan::load(besideConfig(line, options.plan, "plan"));
  const simulation::Route route = simulation::Route::load(besideConfig(line, options.route, "route"));
  const simulation::SimulatedLog log = simulate(plan, route, options, laser, odometry);

  fs::path truth = output, picture = output;
  truth.replace_extension(".tum");
  picture.replace_extension(".png");
  writeTogether(
      {{output,
        [&](const std::string& f) { simulation::writeRawlog(simulation::toRawlog(log, options.form), f); }},
       {truth, [&](const std::string& f) { simulation::writeGroundTruth(log.groundTruth, f); }},
       {picture, [&](const std::string& f) { simulation::writePicture(plan, log.groundTruth, f); }}});
  if (!line.quiet) {
    const double seconds = log.groundTruth.empty()
                               ? 0
                               : mrpt::Clock::toDouble(log.groundTruth.back().timestamp) -
                                     mrpt::Clock::toDouble(log.groundTruth.front().timestamp);
    std::printf("%s: %zu scans, %zu odometry readings, %.1f m in %.1f s; ground truth %s, picture %s\n",
                output.c_str(), log.scans.size(), log.odometry.size(), route.progressAt(seconds).distance,
                seconds, truth.c_str(), picture.c_str());
  }
}

int parseAndRun(int argc, char** argv) {
  CLI::App app(
      "Simulates a robot with a laser in a floor plan: rawlog, ground truth (.tum) and picture (.png).",
      "simul-floorplan");
  CommandLine line;
  app.add_option("config", line.config, "INI file (doc/simulation.md)")->required();
  app.add_option("-o,--output", line.output, "OUT.rawlog; also writes OUT.tum and OUT.png")->required();
  app.add_option("-s,--seed", line.seed, "noise seed, overrides the INI file")->check(CLI::NonNegativeNumber);
  app.add_option("--set", line.settings, "override a key of the INI file, SECTION.KEY=VALUE; repeatable")
      ->allow_extra_args(false);
  app.add_flag("-q,--quiet", line.quiet, "print only errors");
  app.set_version_flag("--version", HYBRID_SLAM_VERSION);
  if (const auto code = parse(app, argc, argv)) return *code;
  run(line);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return exitCodeOf([&] { return parseAndRun(argc, argv); });
}
