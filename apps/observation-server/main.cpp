/// @file main.cpp
/// @brief observation-server: the robot's side; sensors or a rawlog to TCP clients.

#include <CLI/CLI.hpp>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <iostream>

#include "base/Errors.h"
#include "io/IniFile.h"
#include "sensors/PioneerOdometry.h"
#include "sensors/SensorThread.h"
#include "sensors/ServeObservations.h"

namespace {

std::atomic<bool> stop{false};

/// The first asks for an orderly end, the second ends the program at once.
void onSignal(int signal) {
  stop = true;
  std::signal(signal, SIG_DFL);
}

int fail(int code, const std::string& message) {
  std::cerr << "observation-server: error: " << message << "\n";
  return code;
}

int run(int argc, char** argv) {
  CLI::App app{"Serves the observations of sensors, or of a rawlog, to TCP clients", "observation-server"};
  std::string config;
  std::vector<std::string> settings;
  bool isQuiet = false, wantsManual = false;
  app.set_version_flag("--version", "observation-server " HYBRID_SLAM_VERSION);
  app.add_option("config", config, "INI file: [server] and a section for each sensor (doc/live.md)");
  app.add_option("--set", settings, "sets a key of the INI file; repeatable")
      ->type_name("SECTION.KEY=VALUE")
      ->allow_extra_args(false);
  app.add_flag("-q,--quiet", isQuiet, "no summary");
  app.add_flag("--help-config", wantsManual, "prints every key of [server] and of a Pioneer's section");
  app.footer(
      "It says on standard output at which port it listens, and on standard error what happens to sensors\n"
      "and clients. Ctrl-C ends it. Exit: 0 done, 1 the run failed, 2 wrong command line or input.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    return fail(2, std::string(e.what()) + ": command line; see observation-server --help");
  }
  hybrid_slam::ServerOptions options;
  const hybrid_slam::Sections sections{{"server", &options}};
  if (wantsManual) {
    hybrid_slam::PioneerOptions pioneer;
    hybrid_slam::writeManual({{"server", &options}, {"PIONEER", &pioneer}}, std::cout);
    return 0;
  }
  if (config.empty()) return fail(2, "no INI file: command line; expected observation-server config.ini");

  std::signal(SIGPIPE, SIG_IGN);  // MRPT's sockets would end the program when a device hangs up
  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
  try {
    mrpt::config::CConfigFileMemory source;
    hybrid_slam::loadIni(source, config, settings, sections, "", "expected a section [server] (doc/live.md)");
    const auto log = std::make_shared<hybrid_slam::EventLog>("observation-server");
    const std::string summary = hybrid_slam::serveObservations(
        options, source, log, [] { return stop.load(); },
        [&](uint16_t port) { std::cout << "listening at " << options.address << ":" << port << std::endl; });
    if (!isQuiet) std::cout << summary << "\n";
    return 0;
  } catch (const hybrid_slam::InputError& e) {
    return fail(2, e.what());
  } catch (const std::exception& e) {
    return fail(1, "run failed: " + config + "; " + hybrid_slam::messageOf(e));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int code = run(argc, argv);
  std::cout.flush();
  if (hybrid_slam::SensorThread::leftBehind() > 0) std::_Exit(code);  // a driver is still at work
  return code;
}
