/// @file main.cpp
/// @brief simul-floorplan: simulates a robot and its sensors in a floor plan; writes a rawlog and ground
/// truth.
#include <mrpt/config/CConfigFileMemory.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "Program.h"
#include "SettingArguments.h"
#include "base/Errors.h"
#include "files/IniFile.h"
#include "files/InstalledFiles.h"
#include "files/PartialFile.h"
#include "study/simulation/BuildingPlan.h"
#include "study/simulation/EarlierSimulation.h"
#include "study/simulation/MovableThings.h"
#include "study/simulation/Route.h"
#include "study/simulation/SimulationOutput.h"

namespace {

using namespace hybrid_slam;
namespace fs = std::filesystem;

struct CommandLine {
  std::string config, output;
  int seed = -1, session = 0;
  std::vector<std::string> settings;
  bool quiet = false;
};

std::string besideConfig(const CommandLine& line, const std::string& file, const char* key) {
  if (file.empty())
    throw InputError("missing key", std::string("section [simulation], key `") + key + "`",
                     "expected a file name");
  return (fs::path(line.config).parent_path() / file).lexically_normal().string();
}

using FilesAndWriters = std::vector<std::pair<fs::path, std::function<void(const std::string&)>>>;

/// Writes all files under temporary names first, so that no half-written file has a final name.
void writeTogether(const FilesAndWriters& filesAndWriters) {
  std::vector<std::unique_ptr<files::PartialFile>> parts;
  for (const auto& [file, write] : filesAndWriters)
    parts.push_back(std::make_unique<files::PartialFile>(file.string()));
  for (size_t i = 0; i < parts.size(); ++i) {
    errno = 0;
    try {
      filesAndWriters[i].second(parts[i]->path());
    } catch (const std::exception& e) {
      if (isOutOfMemory(e)) throw;
      parts[i]->fail(errno);
    }
  }
  for (const auto& part : parts) part->commit();
}

void run(const CommandLine& line) {
  simulation::SimulationOptions options;
  simulation::LaserOptions laser;
  simulation::OdometryOptions odometry;
  mrpt::config::CConfigFileMemory source;
  warn(files::loadIni(source, line.config, line.settings,
                      {{"simulation", &options}, {"laser", &laser}, {"odometry", &odometry}}, "",
                      "expected a section [simulation] (doc/simulation.md)"));
  if (line.seed >= 0) options.seed = line.seed;
  if (line.session > 0) options.session = line.session;
  const fs::path output = line.output;
  if (output.extension() != ".rawlog")
    throw InputError("wrong output name `" + line.output + "`", "option -o",
                     "expected a name ending in .rawlog");
  std::error_code ignored;  // such as a folder that may not be entered
  if (output.has_parent_path() && !fs::is_directory(output.parent_path(), ignored))
    throw InputError("no such folder", "folder " + output.parent_path().string(),
                     "expected an existing folder");

  const simulation::SimulationFiles out(output);
  for (const fs::path& file : {out.rawlog, out.truth, out.picture, out.plan})
    for (const std::string& input :
         {line.config, besideConfig(line, options.plan, "plan"), besideConfig(line, options.route, "route"),
          options.things.empty() ? "" : besideConfig(line, options.things, "things")})
      if (fs::equivalent(file, input, ignored))
        throw InputError("the output is an input", file.string(), "expected another name with -o");
  expectReplaceable(out, options.startTime);

  const simulation::BuildingPlan fixed =
      simulation::BuildingPlan::load(besideConfig(line, options.plan, "plan"));
  const simulation::Route route = simulation::Route::load(besideConfig(line, options.route, "route"));
  simulation::MovableThings things;
  if (!options.things.empty())
    things = simulation::MovableThings::load(besideConfig(line, options.things, "things"), fixed);
  const std::vector<simulation::PlacedThing> placed = things.inSession(options.seed, options.session);
  const simulation::BuildingPlan plan = fixed.with(wallsOf(placed));
  const simulation::SimulatedLog log = simulate(plan, route, options, laser, odometry);
  // A route that is clear in one session is clear in all.
  if (!things.empty()) route.checkClear(fixed.with(things.everywhere()), options.robotRadius);

  FilesAndWriters files = {
      {out.rawlog,
       [&](const std::string& f) { simulation::writeRawlog(simulation::toRawlog(log, options.form), f); }},
      {out.truth, [&](const std::string& f) { simulation::writeGroundTruth(log.groundTruth, f); }},
      {out.picture, [&](const std::string& f) { simulation::writePicture(plan, log.groundTruth, f); }}};
  if (!things.empty())
    files.emplace_back(out.plan, [&](const std::string& f) { simulation::writeFloorPlan(fixed, placed, f); });
  writeTogether(files);
  if (things.empty()) fs::remove(out.plan, ignored);  // of an earlier simulation
  if (!line.quiet) {
    const double seconds = log.groundTruth.empty()
                               ? 0
                               : mrpt::Clock::toDouble(log.groundTruth.back().timestamp) -
                                     mrpt::Clock::toDouble(log.groundTruth.front().timestamp);
    const size_t readings =
        options.form == simulation::RawlogForm::pairs ? log.scans.size() : log.odometry.size();
    std::printf("%s: %zu scans, %zu odometry readings, %.1f m in %.1f s; ground truth %s, picture %s\n",
                output.c_str(), log.scans.size(), readings, route.progressAt(seconds).distance, seconds,
                out.truth.c_str(), out.picture.c_str());
  }
}

int parseAndRun(int argc, char** argv) {
  CLI::App app(
      "Simulates a robot with a laser in a floor plan: rawlog, ground truth (.tum) and picture (.png).",
      "simul-floorplan");
  CommandLine line;
  app.add_option("config", line.config, "INI file (doc/simulation.md)")->required();
  app.add_option("-o,--output", line.output,
                 "OUT.rawlog; also writes OUT.tum and OUT.png, and with "
                 "doors or boxes OUT.truth.plan")
      ->required();
  app.add_option("-s,--seed", line.seed, "noise seed, overrides the INI file")
      ->check(CLI::Range(0, std::numeric_limits<int>::max()));
  app.add_option("--session", line.session, "session of the building, overrides the INI file")
      ->check(CLI::Range(1, 1000000));
  addSettings(app, line.settings);
  addQuiet(app, line.quiet);
  app.set_version_flag("--version", "simul-floorplan " HYBRID_SLAM_VERSION);
  if (const auto code = parse(app, argc, argv)) return *code;
  line.config = files::inputFile(line.config);
  run(line);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return exitCodeOf([&] { return parseAndRun(argc, argv); });
}
