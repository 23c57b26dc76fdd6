/// @file main.cpp
/// @brief observation-server: the robot's side; serves sensors or a rawlog to TCP clients.

#include <CLI/CLI.hpp>
#include <iostream>

#include "Program.h"
#include "SensorProgram.h"
#include "SettingArguments.h"
#include "Stop.h"
#include "files/IniFile.h"
#include "files/InstalledFiles.h"
#include "live/TcpSocket.h"
#include "sensors/PioneerOdometry.h"
#include "sensors/ServeObservations.h"

namespace {

using namespace hybrid_slam;

struct CommandLine {
  std::string config;
  std::vector<std::string> settings;
  bool isQuiet = false, wantsManual = false;
};

void describe(CLI::App& app, CommandLine& line) {
  app.set_version_flag("--version", "observation-server " HYBRID_SLAM_VERSION);
  app.add_option("config", line.config, "INI file: [server] and one section per sensor (doc/live.md)");
  addSettings(app, line.settings);
  addQuiet(app, line.isQuiet);
  app.add_flag("--help-config", line.wantsManual, "print every key of [server] and of a Pioneer's section");
  app.footer(
      "The port is printed on standard output, events of sensors and clients on standard error.\n"
      "Ctrl-C ends the server. Exit: 0 done, 1 the run failed, 2 wrong command line or input.");
}

int run(const CommandLine& line) {
  live::ServerOptions options;
  const files::Sections sections{{"server", &options}};
  if (line.wantsManual) {
    sensors::PioneerOptions pioneer;
    const files::Sections all{{"server", &options}, {"PIONEER", &pioneer}};
    (isTerminal() ? files::writePlainManual : files::writeManual)(all, std::cout);
    return 0;
  }
  if (line.config.empty())
    return fail(2, "no INI file: command line; expected observation-server config.ini");
  stopOnSignals();
  mrpt::config::CConfigFileMemory source;
  warn(files::loadIni(source, files::inputFile(line.config), line.settings, sections, "",
                      "expected a section [server] (doc/live.md)"));
  files::findInputFiles({&options.rawlog});
  const auto log = std::make_shared<live::EventLog>("observation-server");
  const std::string summary = sensors::serveObservations(
      options, source, log, [] { return stop.load(); },
      [&](uint16_t port) {
        std::cout << "listening at " << live::addressText(options.address, port) << std::endl;
      });
  if (!line.isQuiet) std::cout << summary << "\n";
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine line;
  const auto parseAndRun = [&] {
    CLI::App app{"Serves observations from sensors or a rawlog to TCP clients", "observation-server"};
    describe(app, line);
    if (const auto code = parse(app, argc, argv)) return *code;
    return run(line);
  };
  return leaveDrivers(
      exitCodeOf(parseAndRun, [&](const std::exception& e) { return runFailed(line.config, e); }));
}
