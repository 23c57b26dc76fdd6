/// @file main.cpp
/// @brief motion-model-learn: learns a robot's motion model from a log (doc/motion-model.md).

#include <mrpt/core/bits_math.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>

#include "FilterArguments.h"
#include "InputFiles.h"
#include "Program.h"
#include "SettingArguments.h"
#include "Stop.h"
#include "files/InputFile.h"
#include "files/OutputFolder.h"
#include "readings/LogWarnings.h"
#include "run/FilteredMotions.h"
#include "run/LogSettings.h"
#include "run/MotionModelText.h"

namespace {

using namespace hybrid_slam;

struct CommandLine {
  InputFiles files;
  std::string output;
  int iterations = 10;
  FilterArguments filter;
  std::vector<std::string> settings;
  bool isQuiet = false;
};

void describe(CLI::App& app, CommandLine& line) {
  app.set_version_flag("--version", "motion-model-learn " HYBRID_SLAM_VERSION);
  line.files.add(app, logMeans());
  app.add_option("-o,--output", line.output, "INI file to write, with the learnt [motion_model]")
      ->required()
      ->type_name("FILE");
  app.add_option("--iterations", line.iterations,
                 "stop after this many iterations even if the likelihood still rises")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str()
      ->type_name("N");
  line.filter.addParticles(app);
  addSettings(app, line.settings);
  addQuiet(app, line.isQuiet);
  app.footer(
      "Learn with the proposal, update_distance and update_angle_deg you will run with, then\n"
      "  cat config.ini motion.ini > learnt.ini\n"
      "gives config.ini with the learnt model.\n"
      "Exit: 0 done, 1 the run failed or covers only part of the log, 2 wrong command line or input.");
}

run::Configuration configurationOf(const CommandLine& line, const CLI::App& app) {
  std::vector<std::string> settings = line.settings;
  set(settings, "run.rawlog", line.files.log);
  line.filter.addTo(settings, app);
  return run::Configuration(line.files.config, settings);
}

constexpr const char* kOrigin = "Learnt by motion-model-learn";

/// INI comments on the origin of the learnt section.
std::vector<std::string> comments(const CommandLine& line, const run::Configuration& configuration,
                                  const EmIteration& prior, const LearntMotionModel& learnt) {
  const auto text = [](const auto&... parts) {
    std::ostringstream out;
    (out << ... << parts);
    return out.str();
  };
  const UpdateInterval interval = configuration.filter.updateInterval();
  const std::string priorName = line.files.config.empty() ? "the defaults" : line.files.config;
  std::vector<std::string> all{
      text(kOrigin, " " HYBRID_SLAM_VERSION " from ", line.files.log, " with ", priorName, "."),
      text("For updates every ", interval.distance, " m or ", mrpt::RAD2DEG(interval.angle),
           " deg: the variances hold for steps of this size."),
      text(learnt.best.number, " iterations; log-likelihood per update ", learnt.best.logLikelihood,
           " (the prior's: ", prior.logLikelihood, ")."),
      line.files.config.empty() ? text("Use: hybrid-slam ", line.output, " LOG")
                                : text("Use: cat ", line.files.config, " ", line.output, " > learnt.ini")};
  for (const auto& [keys, why] : learnt.determined.lacks)
    all.push_back(
        text("Not learnt but kept from ", priorName, ": ", keys, " of distance, drift and turn: ", why));
  return all;
}

int learn(const CommandLine& line, run::Configuration configuration) {
  for (const std::string& input : {line.files.config, line.files.log}) {
    std::error_code ignored;
    if (std::filesystem::equivalent(input, line.output, ignored))
      throw InputError("the output is the input", line.output, "expected another name after -o");
  }
  files::expectReplaceable(line.output, "learnt motion model", [](const std::string& file) {
    std::ifstream text(file);
    std::string row;
    bool isOurs = std::getline(text, row) && row.rfind(std::string("# ") + kOrigin, 0) == 0;
    while (isOurs && std::getline(text, row)) isOurs = row[0] != '[' || row == "[motion_model]";
    return isOurs;
  });
  warn(configuration.warnings);
  readings::RawlogSummary log = summarise(line.files.log, configuration.input, [] { return stop.load(); });
  if (!log.hasMotion)
    throw InputError("no odometry", line.files.log, "expected a log with odometry, whose errors are learnt");
  warn(readings::warningsOf(log, line.files.log));
  for (const std::string& text :
       applyLogSettings(run::readLogSettings(line.files.log, configuration.input, log), configuration))
    if (!line.isQuiet) std::cout << text << "\n";
  log.adapt(line.files.log, configuration.input);
  files::GrowingFile output(line.output);  // opened now: a wrong name fails before the run

  int iteration = 0;
  const auto eStep = [&](const MotionModelOptions& model) {
    configuration.filter.motion = model;
    return run::filteredMotions(configuration, log, line.isQuiet, "iteration " + std::to_string(iteration++),
                                stop);
  };
  EmIteration prior;
  const auto report = [&](const EmIteration& done) {
    if (done.number == 0) prior = done;
    if (line.isQuiet) return;
    if (done.number == 0) std::cout << run::motionModelTableHead();
    std::cout << run::motionModelTableRow(done.number, done.logLikelihood, done.model) << std::flush;
  };
  const LearntMotionModel learnt =
      learnMotionModel(configuration.filter.motion, eStep, line.iterations, line.files.log, report);
  for (const auto& [keys, why] : learnt.determined.lacks)
    warn({"prior kept for " + keys + " of distance, drift and turn: " + line.files.log + "; " + why});
  if (learnt.best.number == 0)
    warn({"nothing learnt, the prior is kept: " + line.files.log +
          "; no iteration makes the log more likely"});
  output.stream() << run::motionModelSection(learnt.best.model, comments(line, configuration, prior, learnt));
  output.finish();
  if (!line.isQuiet)
    std::cout << (learnt.isConverged ? "converged" : "not converged; raise --iterations") << ": iteration "
              << learnt.best.number << " written to " << line.output << "\n";
  if (!log.defect.empty())
    return fail(1, "log " + log.defect + ": " + log.defectPlace(line.files.log) +
                       "; learnt from the log up to this point");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine line;
  const auto parseAndLearn = [&] {
    CLI::App app{"Learns the motion model of a robot from a log by EM (Eliazar & Parr)"};
    describe(app, line);
    if (const auto code = parse(app, argc, argv)) return *code;
    line.files.sort();
    if (line.files.log.empty())
      return fail(2, "no log: command line; expected motion-model-learn [config.ini] LOG -o FILE");
    stopOnSignals();
    return learn(line, configurationOf(line, app));
  };
  return exitCodeOf(parseAndLearn, [&](const std::exception& e) {
    return stop ? messageOf(e) + "; nothing was written" : runFailed(line.files.main(), e);
  });
}
