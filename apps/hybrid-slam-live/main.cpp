/// @file main.cpp
/// @brief hybrid-slam-live: the filter on live data from sensors or an observation-server.

#include <CLI/CLI.hpp>
#include <iostream>

#include "FilterArguments.h"
#include "OutputArgument.h"
#include "Program.h"
#include "SaveSignal.h"
#include "SensorProgram.h"
#include "SessionArguments.h"
#include "SettingArguments.h"
#include "Stop.h"
#include "base/Errors.h"
#include "files/InstalledFiles.h"
#include "live/ObservationClient.h"
#include "live/Token.h"
#include "live_run/LiveRun.h"
#include "sensors/SensorSource.h"

namespace {

using namespace hybrid_slam;

struct CommandLine {
  std::string config, server, output;
  FilterArguments filter;
  SessionArguments session;
  std::vector<std::string> settings;
  bool isQuiet = false, overwrites = false, wantsManual = false;
};

void describe(CLI::App& app, CommandLine& line) {
  app.set_version_flag("--version", "hybrid-slam-live " HYBRID_SLAM_VERSION);
  app.add_option("config", line.config, "INI file (doc/configuration.md; [live] and sensors: doc/live.md)");
  app.add_option("--server", line.server,
                 "read from this observation-server, not from the INI file's sensors")
      ->type_name("HOST:PORT");
  addOutput(app, line.output, "folder for results and recording");
  app.add_flag("--overwrite", line.overwrites,
               "replace the results of an earlier run in DIR, but never a recording (default: write to a "
               "dated subfolder)");
  line.filter.addMethod(app);
  line.filter.addParticles(app, "random seed; same seed and recording: identical results");
  line.session.addCheckpoints(app);
  line.session.addMap(app);
  addSettings(app, line.settings);
  addQuiet(app, line.isQuiet);
  app.add_flag("--help-config", line.wantsManual, "print every key of section [live]");
  app.footer(
      "Results: those of hybrid-slam (doc/results.md) and recording-DATE.rawlog, which hybrid-slam "
      "replays.\n"
      "Ctrl-C ends the run and writes the results. SIGUSR1 saves map and session to saved-DATE in DIR; the\n"
      "run continues.\n"
      "Exit: 0 done, 1 the run failed, 2 wrong command line or input.");
}

std::vector<std::string> settingsOf(const CommandLine& line, const CLI::App& app) {
  std::vector<std::string> settings = line.settings;
  if (!line.server.empty()) set(settings, "live.server", line.server);
  if (!line.output.empty()) set(settings, "run.output", line.output);
  line.filter.addTo(settings, app);
  return settings;
}

/// Runs until Ctrl-C or the end of the log that the server replays. @return the summary
std::string runLive(run::Configuration& configuration, const live::LiveOptions& options, bool isQuiet) {
  const auto log = std::make_shared<live::EventLog>("hybrid-slam-live");
  std::unique_ptr<live::CycleSource> source;
  const live::ObservationClient* client = nullptr;
  if (options.server.empty()) {
    source = std::make_unique<sensors::SensorSource>(configuration.source, options.cycleRate,
                                                     options.sensorTimeout, log);
  } else {
    const auto [host, port] = live::hostAndPort(options.server, "section [live], key `server`");
    auto owned = std::make_unique<live::ObservationClient>(
        live::ObservationClient::Settings{
            host, port, options.timeout,
            live::readToken(options.tokenFile, "section [live], key `token_file`")},
        *log);
    client = owned.get();
    source = std::move(owned);
  }
  live::LiveRun run(configuration, options, *log, isQuiet);
  const auto finish = [&] {
    const size_t lost = client ? client->lost() : 0;
    source.reset();  // else observations would pile up unread
    return run.finish(lost, live::kPatience);
  };
  try {
    source->run([&](const mrpt::obs::CSensoryFrame::Ptr& cycle) { run.take(cycle); },
                [&] {
                  if (takeSaveSignal()) run.requestSave();
                  return stop || run.hasFailed();
                });
  } catch (const std::exception&) {
    try {
      finish();  // the results so far
    } catch (const std::exception& e) {
      log->report("results", messageOf(e));
    }
    throw;
  }
  return finish();
}

int execute(const CommandLine& line, const std::vector<std::string>& settings) {
  live::LiveOptions options;
  const files::Sections sections{{"live", &options}};
  if (line.wantsManual) {
    (isTerminal() ? files::writePlainManual : files::writeManual)(sections, std::cout);
    return 0;
  }
  if (line.config.empty() && line.server.empty())
    return fail(2, "no INI file: command line; expected hybrid-slam-live config.ini, or --server HOST:PORT");
  stopOnSignals();
  holdSaveSignal();
  run::Configuration configuration(line.config.empty() ? "" : files::inputFile(line.config), settings,
                                   sections);
  expectKept(line.output, configuration.run.output);
  configuration.run.overwrite = line.overwrites;
  line.session.addTo(configuration.run);
  warn(configuration.warnings);
  const std::string summary = runLive(configuration, options, line.isQuiet);
  if (!line.isQuiet) std::cout << summary << "\n";
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine line;
  const auto parseAndRun = [&] {
    CLI::App app{
        "Maps while the robot drives: hybrid-slam on live data from sensors or an observation-server",
        "hybrid-slam-live"};
    describe(app, line);
    if (const auto code = parse(app, argc, argv)) return *code;
    return execute(line, settingsOf(line, app));
  };
  return leaveDrivers(exitCodeOf(parseAndRun, [&](const std::exception& e) {
    return runFailed(line.config.empty() ? line.server : line.config, e);
  }));
}
