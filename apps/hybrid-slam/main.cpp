/// @file main.cpp
/// @brief hybrid-slam: replays a rawlog through the filter.

#include <CLI/CLI.hpp>
#include <csignal>
#include <iostream>

#include "base/Errors.h"
#include "io/Replay.h"

namespace {

std::atomic<bool> stop{false};

/// The first asks for the results so far, the second ends the program at once.
void onSignal(int signal) {
  stop = true;
  std::signal(signal, SIG_DFL);
}

int fail(int code, const std::string& message) {
  std::cerr << "hybrid-slam: error: " << message << "\n";
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Replays a rawlog through the hybrid RBPF: grid maps with line directions"};
  std::string config, rawlog, output, method, proposal;
  int particles = 0, seed = -1, threads = -1, refine = 0;
  std::vector<std::string> settings;
  bool isQuiet = false, wantsProfile = false, wantsManual = false;
  app.set_version_flag("--version", "hybrid-slam " HYBRID_SLAM_VERSION);
  app.add_option("config", config, "INI file (doc/configuration.md)");
  app.add_option("dataset", rawlog, "rawlog, plain or gzipped; else [run] rawlog of the INI file");
  app.add_option("-o,--output", output, "folder for the results, made if it is missing")->type_name("DIR");
  app.add_option("-m,--method", method, "hybrid, general (without lines) or stock (MRPT's own RBPF)");
  app.add_option("-p,--proposal", proposal, "standard, improved, auxiliary_standard or auxiliary_optimal");
  app.add_option("-n,--particles", particles, "number of particles")->type_name("N");
  app.add_option("-s,--seed", seed, "same seed, same results to the byte")->type_name("N");
  app.add_option("-j,--threads", threads, "threads over particles; 0: all cores")->type_name("N");
  app.add_option("--refine", refine, "afterwards: matches each scan against the final map, N times")
      ->type_name("N");
  app.add_option("--set", settings, "sets a key of the INI file; repeatable")
      ->type_name("SECTION.KEY=VALUE")
      ->allow_extra_args(false);
  app.add_flag("-q,--quiet", isQuiet, "no progress and no summary");
  app.add_flag("--profile", wantsProfile, "prints how long each stage of the run took, and how often it ran");
  app.add_flag("--help-config", wantsManual, "prints every section and key of the INI file");
  app.footer(
      "Results: trajectory.tum, map.png, map.pgm + map.yaml, map.gridmap.gz, map.simplemap.gz, lines.csv,\n"
      "steps.csv, metrics.json, config.ini (doc/results.md). Ctrl-C ends the run and writes them.\n"
      "Exit: 0 done, 1 the run failed or covers only part of the log, 2 wrong command line or input.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    return fail(2, std::string(e.what()) + ": command line; see hybrid-slam --help");
  }
  if (wantsManual) {
    std::cout << hybrid_slam::configurationManual();
    return 0;
  }
  if (config.empty())
    return fail(2, "no INI file: command line; expected hybrid-slam config.ini [dataset.rawlog]");

  // What the command line says is a setting like any other, so it is checked in the same place.
  const auto set = [&settings](const std::string& key, const std::string& value) {
    settings.push_back(key + "=" + value);
  };
  if (!rawlog.empty()) set("run.rawlog", rawlog);
  if (!output.empty()) set("run.output", output);
  if (!method.empty()) set("run.method", method);
  if (!proposal.empty()) set("particle_filter.proposal", proposal);
  if (app.count("--particles")) set("particle_filter.particles", std::to_string(particles));
  if (app.count("--seed")) set("particle_filter.seed", std::to_string(seed));
  if (app.count("--threads")) set("particle_filter.threads", std::to_string(threads));

  if (app.count("--refine")) set("run.refine", std::to_string(refine));

  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
  try {
    hybrid_slam::Configuration configuration(config, settings);
    if (configuration.run.rawlog.empty())
      return fail(2,
                  "no rawlog: command line; expected hybrid-slam config.ini dataset.rawlog, or [run] rawlog");
    const auto outcome = hybrid_slam::replay(configuration, isQuiet, stop, HYBRID_SLAM_VERSION, wantsProfile);
    for (const std::string& warning : outcome.warnings)
      std::cerr << "hybrid-slam: warning: " << warning << "\n";
    if (!isQuiet) std::cout << outcome.summary << "\n";
    std::cout << outcome.profile;
    return outcome.incomplete.empty() ? 0 : fail(1, outcome.incomplete);
  } catch (const hybrid_slam::InputError& e) {
    return fail(2, e.what());
  } catch (const std::exception& e) {
    return fail(1, "run failed: " + config + "; " + hybrid_slam::messageOf(e));
  }
}
