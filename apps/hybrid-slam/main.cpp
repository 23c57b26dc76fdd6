/// @file main.cpp
/// @brief hybrid-slam: replays a rawlog through the filter.

#include <CLI/CLI.hpp>
#include <iostream>

#include "FilterArguments.h"
#include "InputFiles.h"
#include "OutputArgument.h"
#include "Program.h"
#include "SessionArguments.h"
#include "SettingArguments.h"
#include "Stop.h"
#include "TopicArguments.h"
#include "run/Replay.h"
#include "run/SessionFile.h"

namespace {

using namespace hybrid_slam;

struct CommandLine {
  InputFiles files;
  std::string output;
  FilterArguments filter;
  TopicArguments topics;
  SessionArguments session;
  std::vector<std::string> settings;
  int refine = 0;
  bool isQuiet = false, isStrict = false, overwrites = false, wantsProfile = false, wantsManual = false;
};

void describe(CLI::App& app, CommandLine& line) {
  app.set_version_flag("--version", "hybrid-slam " HYBRID_SLAM_VERSION);
  line.files.add(app, logMeans() + " (default: [run] rawlog)");
  addOutput(app, line.output, "folder for the results, created if missing");
  app.add_flag("--overwrite", line.overwrites,
               "replace the results of an earlier run in DIR (default: write to a dated subfolder)");
  line.filter.addMethod(app);
  line.filter.addParticles(app);
  app.add_option("--refine", line.refine,
                 "after the run, match every scan to the final map and rebuild the map, N times (default: 1)")
      ->type_name("N");
  line.topics.add(app, true);
  line.session.addResume(app);
  line.session.addMap(app);
  addSettings(app, line.settings);
  app.add_flag("--strict", line.isStrict, "exit 1 if the verdict on the map is `lost`");
  addQuiet(app, line.isQuiet);
  app.add_flag("--profile", line.wantsProfile, "print time and call count of each stage");
  app.add_flag("--help-config", line.wantsManual, "print every section and key of the INI file");
  app.footer(
      "Settings that depend on the sensor are derived from the log and printed; the INI file and --set\n"
      "override them.\n"
      "Results: trajectory.tum, covariance.csv, map.png, map.pgm + map.yaml, map.gridmap.gz,\n"
      "map.simplemap.gz, lines.csv, plan.svg, plan.dxf, plan.geojson, steps.csv, metrics.json, config.ini,\n"
      "session.hslam (doc/results.md). Ctrl-C ends the run and writes the results.\n"
      "Exit: 0 done, 1 the run failed, covers only part of the log or (--strict) is lost,\n"
      "2 wrong command line or input.");
}

std::vector<std::string> settingsOf(const CommandLine& line, const CLI::App& app) {
  std::vector<std::string> settings = line.settings;
  if (!line.files.log.empty()) set(settings, "run.rawlog", line.files.log);
  if (!line.output.empty()) set(settings, "run.output", line.output);
  line.filter.addTo(settings, app);
  line.topics.addTo(settings);
  if (app.count("--refine")) set(settings, "run.refine", std::to_string(line.refine));
  return settings;
}

/// Rejects --refine where it would do nothing.
void expectRefinable(const run::RunOptions& run) {
  using Method = run::RunOptions::Method;
  if (!run.localizeIn.empty())
    throw InputError("--refine with --localize", "command line",
                     "expected one: localisation leaves the map as it is");
  if (run.method != Method::hybrid && run.method != Method::general)
    throw InputError("--refine with method " + nameOf(run.method), "command line",
                     "expected method hybrid or general");
}

/// Rejects a session given as the log.
void expectNoSession(const std::string& log) {
  if (run::isSession(log))
    throw InputError("a session, not a log", log,
                     "expected a log; --resume, --continue and --localize take sessions");
}

int execute(const CommandLine& line, const std::vector<std::string>& settings) {
  if (line.wantsManual) {
    std::cout << (isTerminal() ? run::plainConfigurationManual() : run::configurationManual());
    return 0;
  }
  const std::string usage = "expected hybrid-slam [config.ini] LOG";
  run::Configuration configuration(line.files.config, settings);
  expectKept(line.files.log, configuration.run.rawlog);
  expectKept(line.output, configuration.run.output);
  configuration.run.overwrite = line.overwrites;
  line.session.addTo(configuration.run);
  if (line.refine > 0) expectRefinable(configuration.run);
  if (configuration.run.rawlog.empty() && line.session.resume.empty())
    return fail(2, "no log: command line; " + usage + ", or [run] rawlog");
  warn(configuration.warnings);
  expectNoSession(configuration.run.rawlog);
  if (line.topics.wantsList) {
    printTopics(configuration.run.rawlog);
    return 0;
  }
  stopOnSignals();
  const auto outcome = run::replay(configuration, line.isQuiet, stop, line.wantsProfile);
  warn(outcome.warnings);
  if (!line.isQuiet) std::cout << outcome.summary << "\n" << outcome.verdict.line() << "\n";
  std::cout << outcome.profile;
  if (!outcome.incomplete.empty()) return fail(1, outcome.incomplete);
  const bool isLost = outcome.verdict.level == run::Verdict::Level::lost;
  return line.isStrict && isLost ? fail(1, outcome.verdict.line()) : 0;
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine line;
  const auto parseAndRun = [&] {
    CLI::App app{"Maps a log with the hybrid particle filter: occupancy grids and line directions"};
    describe(app, line);
    if (const auto code = parse(app, argc, argv)) return *code;
    line.files.sort();
    return execute(line, settingsOf(line, app));
  };
  return exitCodeOf(parseAndRun, [&](const std::exception& e) { return runFailed(line.files.main(), e); });
}
