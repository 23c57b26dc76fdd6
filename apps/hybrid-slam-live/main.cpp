/// @file main.cpp
/// @brief hybrid-slam-live: the filter fed by sensors or by an observation-server.

#include <CLI/CLI.hpp>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <iostream>

#include "base/Errors.h"
#include "live/LiveRun.h"
#include "live/ObservationClient.h"
#include "sensors/SensorSource.h"

namespace {

using namespace hybrid_slam;

std::atomic<bool> stop{false};

/// The first ends the run and asks for its results, the second ends the program at once.
void onSignal(int signal) {
  stop = true;
  std::signal(signal, SIG_DFL);
}

int fail(int code, const std::string& message) {
  std::cerr << "hybrid-slam-live: error: " << message << "\n";
  return code;
}

/// Runs until Ctrl-C, or the end of the log that the server replays. @return the summary
std::string runLive(Configuration& configuration, const LiveOptions& options, bool isQuiet) {
  const auto log = std::make_shared<EventLog>("hybrid-slam-live");
  std::unique_ptr<CycleSource> source;
  const ObservationClient* client = nullptr;
  if (options.server.empty()) {
    source =
        std::make_unique<SensorSource>(configuration.source, options.cycleRate, options.sensorTimeout, log);
  } else {
    const auto [host, port] = hostAndPort(options.server, "section [live], key `server`");
    auto owned =
        std::make_unique<ObservationClient>(ObservationClient::Settings{host, port, options.timeout}, *log);
    client = owned.get();
    source = std::move(owned);
  }
  LiveRun run(configuration, options, *log, isQuiet);
  source->run([&](const mrpt::obs::CSensoryFrame::Ptr& cycle) { run.take(cycle); },
              [&] { return stop || run.hasFailed(); });
  return run.finish(HYBRID_SLAM_VERSION, client ? client->lost() : 0);
}

int run(int argc, char** argv) {
  CLI::App app{"Maps while the robot drives: hybrid-slam fed by sensors or by an observation-server",
               "hybrid-slam-live"};
  std::string config, server, output, method, proposal;
  int particles = 0, seed = -1, threads = -1;
  std::vector<std::string> settings;
  bool isQuiet = false, wantsManual = false;
  app.set_version_flag("--version", "hybrid-slam-live " HYBRID_SLAM_VERSION);
  app.add_option("config", config, "INI file: doc/configuration.md, [live] and sensors: doc/live.md");
  app.add_option("--server", server, "an observation-server, instead of the INI file's sensors")
      ->type_name("HOST:PORT");
  app.add_option("-o,--output", output, "folder for the results and the recording")->type_name("DIR");
  app.add_option("-m,--method", method, "hybrid, general (without lines) or stock (MRPT's own RBPF)");
  app.add_option("-p,--proposal", proposal, "standard, improved, auxiliary_standard or auxiliary_optimal");
  app.add_option("-n,--particles", particles, "number of particles")->type_name("N");
  app.add_option("-s,--seed", seed, "same seed, same recording: same results to the byte")->type_name("N");
  app.add_option("-j,--threads", threads, "threads over particles; 0: all cores")->type_name("N");
  app.add_option("--set", settings, "sets a key of the INI file; repeatable")
      ->type_name("SECTION.KEY=VALUE")
      ->allow_extra_args(false);
  app.add_flag("-q,--quiet", isQuiet, "no state every 10 s and no summary");
  app.add_flag("--help-config", wantsManual, "prints every key of section [live]");
  app.footer(
      "Results: those of hybrid-slam (doc/results.md) and recording.rawlog, which hybrid-slam replays. "
      "Ctrl-C\n"
      "ends the run and writes them. Exit: 0 done, 1 the run failed, 2 wrong command line or input.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    return fail(2, std::string(e.what()) + ": command line; see hybrid-slam-live --help");
  }
  LiveOptions options;
  const Sections sections{{"live", &options}};
  if (wantsManual) {
    writeManual(sections, std::cout);
    return 0;
  }
  if (config.empty()) return fail(2, "no INI file: command line; expected hybrid-slam-live config.ini");

  // What the command line says is a setting like any other, so it is checked in the same place.
  const auto set = [&settings](const std::string& key, const std::string& value) {
    settings.push_back(key + "=" + value);
  };
  if (!server.empty()) set("live.server", server);
  if (!output.empty()) set("run.output", output);
  if (!method.empty()) set("run.method", method);
  if (!proposal.empty()) set("particle_filter.proposal", proposal);
  if (app.count("--particles")) set("particle_filter.particles", std::to_string(particles));
  if (app.count("--seed")) set("particle_filter.seed", std::to_string(seed));
  if (app.count("--threads")) set("particle_filter.threads", std::to_string(threads));

  std::signal(SIGPIPE, SIG_IGN);  // MRPT's sockets would end the program when a device hangs up
  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
  try {
    Configuration configuration(config, settings, sections);
    const std::string summary = runLive(configuration, options, isQuiet);
    if (!isQuiet) std::cout << summary << "\n";
    return 0;
  } catch (const InputError& e) {
    return fail(2, e.what());
  } catch (const std::exception& e) {
    return fail(1, "run failed: " + config + "; " + messageOf(e));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int code = run(argc, argv);
  std::cout.flush();
  if (SensorThread::leftBehind() > 0) std::_Exit(code);  // a driver is still at work
  return code;
}
