/// @file main.cpp
/// @brief slam-compare: runs methods side by side over many seeds; tables, plots, report
/// (doc/slam-compare.md).

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>
#include <thread>

#include "InputFiles.h"
#include "OutputArgument.h"
#include "Program.h"
#include "SettingArguments.h"
#include "Stop.h"
#include "files/InstalledFiles.h"
#include "files/OutputFolder.h"
#include "readings/EndPointReader.h"
#include "readings/LogWarnings.h"
#include "readings/RawlogSource.h"
#include "run/Configuration.h"
#include "run/JsonText.h"
#include "run/LogSettings.h"
#include "run/TrajectoryRecorder.h"
#include "study/comparison/Comparison.h"
#include "study/comparison/Report.h"
#include "study/comparison/RunSetup.h"
#include "study/comparison/Sweep.h"

namespace {

using namespace hybrid_slam;
namespace fs = std::filesystem;

struct CommandLine {
  InputFiles files;
  std::string output, reference, relations, odometry, floorplan;
  std::vector<std::string> methods{"hybrid", "general"}, particles, variants, settings;
  int seeds = 30, firstSeed = 1, jobs = 0;
  std::optional<double> revisits;  // m
  comparison::SuccessCriterion criterion;
  bool isReportOnly = false, isListOnly = false, isQuiet = false;
};

void describe(CLI::App& app, CommandLine& line) {
  app.set_version_flag("--version", "slam-compare " HYBRID_SLAM_VERSION);
  line.files.add(app, logMeans());
  addOutput(app, line.output, "folder for runs, tables and report, created if missing")->required();
  app.add_option("-m,--methods", line.methods,
                 "list of hybrid, general, linemap, ortho, stock; the first is the baseline of the tests")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str();
  app.add_option("-n,--particles", line.particles,
                 "particle counts for all methods or one (default: the INI file's)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("[METHOD:]N");
  app.add_option("--seeds", line.seeds, "runs per group")->capture_default_str();
  app.add_option("--first-seed", line.firstSeed, "first seed; the others count up from it")
      ->capture_default_str();
  app.add_option("--variant", line.variants,
                 "extra group with these settings on top of the INI file, for METHOD or all methods; @FILE: "
                 "another INI file; repeatable")
      ->type_name("[METHOD/]NAME:SECTION.KEY=VALUE[,...]")
      ->allow_extra_args(false);
  addSettings(app, line.settings, "override a key of the INI file for all runs; repeatable");
  app.add_option("-j,--jobs", line.jobs, "parallel runs; 0: one per core")->capture_default_str();
  app.add_option("--reference", line.reference, "TUM file of true poses, for ATE, return error, success");
  app.add_option("--relations", line.relations, "relations file, for the relations metric, success");
  app.add_option("--odometry", line.odometry,
                 "file `t x y theta` to extrapolate poses to the relations' times");
  app.add_option("--floorplan", line.floorplan,
                 "floor plan in the reference's frame, for map errors and doubled walls");
  app.add_option("--revisits", line.revisits,
                 "revisit error between scans up to DISTANCE apart, m (slam-eval revisits)")
      ->type_name("DISTANCE");
  app.add_option("--success-trans", line.criterion.returnTrans,
                 "success bound: position error at the return, m")
      ->capture_default_str();
  app.add_option("--success-rot", line.criterion.returnRot, "success bound: heading error at the return, deg")
      ->capture_default_str();
  app.add_option("--success-doubled", line.criterion.doubledShare, "success bound: share of doubled wall")
      ->capture_default_str();
  app.add_option("--success-relations", line.criterion.relations,
                 "success bound: mean translation error of the relations, m")
      ->capture_default_str();
  app.add_option("--success-revisit", line.criterion.revisits,
                 "success bound: median revisit error, m; needs at least one revisit")
      ->capture_default_str();
  app.add_flag("--report-only", line.isReportOnly, "start no runs; tables and report of the finished ones");
  app.add_flag("--list", line.isListOnly,
               "start no runs; print the name of each, a tab, and its command without `-o FOLDER`");
  addQuiet(app, line.isQuiet);
  app.footer(
      "Runs: DIR/runs/METHOD[-VARIANT]-PARTICLES-SEED/. Results: DIR/results.csv, summary.csv,\n"
      "summary.json, report.html. Finished runs are kept: after Ctrl-C the same command continues.\n"
      "Exit: 0 done, 1 interrupted or a run failed, 2 wrong command line or input.");
}

void check(const CommandLine& line) {
  const auto expect = [](bool isRight, const std::string& option, const std::string& expected) {
    if (!isRight) throw InputError("wrong value", "option " + option, expected);
  };
  expect(line.seeds >= 1 && line.seeds <= 1000, "--seeds", "expected 1..1000");
  expect(line.firstSeed >= 0, "--first-seed", "expected 0 or more");
  expect(line.jobs >= 0, "--jobs", "expected 0 or more");
  expect(line.criterion.returnTrans > 0, "--success-trans", "expected a number of metres above 0");
  expect(line.criterion.returnRot > 0, "--success-rot", "expected a number of degrees above 0");
  expect(line.criterion.doubledShare > 0, "--success-doubled", "expected a share above 0");
  expect(line.criterion.relations > 0, "--success-relations", "expected a number of metres above 0");
  expect(line.criterion.revisits > 0, "--success-revisit", "expected a number of metres above 0");
  expect(line.revisits.value_or(1) > 0, "--revisits", "expected a number of metres above 0");
  if (line.files.log.empty())
    throw InputError("no log", "command line", "expected slam-compare [config.ini] LOG -o DIR");
  for (const std::string& setting : line.settings) comparison::checkSetting(setting, "option --set");
  if (!line.odometry.empty() && line.relations.empty())
    throw InputError("odometry without relations", "option --odometry", "expected --relations as well");
  if (!line.floorplan.empty() && line.reference.empty())
    throw InputError("floor plan without reference", "option --floorplan",
                     "expected --reference as well, which places the maps in the plan");
}

comparison::GroundTruth loadTruth(const CommandLine& line) {
  comparison::GroundTruth truth;
  truth.criterion = line.criterion;
  if (!line.reference.empty()) truth.reference = files::loadTum(line.reference);
  if (!line.relations.empty()) truth.relations = evaluation::loadRelations(line.relations);
  if (!line.odometry.empty()) truth.odometry = files::loadOdometry(line.odometry);
  if (!line.floorplan.empty()) truth.plan = simulation::BuildingPlan::load(line.floorplan);
  if (line.revisits) {
    truth.revisits.emplace();
    truth.revisits->distance = *line.revisits;
  }
  return truth;
}

std::string besideThisProgram(const std::string& program) {
  std::error_code error;
  const fs::path beside = fs::read_symlink("/proc/self/exe", error).parent_path() / program;
  return fs::exists(beside, error) ? beside.string() : program;
}

/// Ends the program after Ctrl-C outside the runs.
void expectNoStop(const std::string& where) {
  if (stop) throw std::runtime_error("interrupted: " + where);
}

/// Says which lasers the groups take, and what is wrong with the log. Of groups after the first one, it says
/// only what differs.
class LogTeller {
 public:
  explicit LogTeller(const CommandLine& line) : line_(line) {}
  void operator()(const comparison::Group& group, const readings::RawlogSummary& log,
                  const run::LogSettings& settings) {
    const std::string whose = told_.empty() ? "" : group.label() + ": ";
    for (const std::string& text : readings::warningsOf(log, line_.files.log))
      if (told_.insert(text).second) warn({whose + text});
    for (const std::string& text : settings.lasers)
      if (told_.insert(text).second && !line_.isQuiet && !line_.isListOnly)
        std::cout << onOneLine(whose + text) << std::endl;
  }

 private:
  const CommandLine& line_;
  std::set<std::string> told_;
};

struct LogSpan {
  files::Trajectory deadReckoning;
  double duration = 0;  ///< s
};

/// One pass over the log, which finds errors before any run starts.
LogSpan readLog(const CommandLine& line, const comparison::RunSetup& setup) {
  const readings::InputOptions input = setup.configuration().input;
  const readings::RawlogSummary summary =
      readings::summarise(line.files.log, input, [] { return stop.load(); });
  readings::RawlogSource source(line.files.log, input, summary);
  run::TrajectoryRecorder recorder;
  while (const auto reading = source.next()) {
    expectNoStop(source.place());
    recorder.add(reading->timestamp, reading->motion, 0);
  }
  return {recorder.trajectory({}), summary.duration};
}

/// Allows one comparison at a time in a folder.
class FolderLock {
 public:
  explicit FolderLock(const files::OutputFolder& folder)
      : file_(open(folder.path(".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
    if (file_ >= 0 && flock(file_, LOCK_EX | LOCK_NB) != 0)
      throw InputError("another slam-compare is running", "folder " + folder.path(""),
                       "expected a separate folder");
  }
  ~FolderLock() {
    if (file_ >= 0) close(file_);
  }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_;
};

/// Rejects tables that would replace other files.
void expectFree(const CommandLine& line, const std::vector<comparison::Variant>& variants,
                const fs::path& runs) {
  std::vector<std::string> inputs = {line.files.config, line.files.log, line.reference,
                                     line.relations,    line.odometry,  line.floorplan};
  for (const comparison::Variant& variant : variants) inputs.push_back(variant.iniFile);
  std::error_code none;
  for (const char* report : {"results.csv", "summary.csv", "summary.json", "report.html"}) {
    const fs::path file = fs::path(line.output) / report;
    if (!fs::exists(runs, none) && fs::exists(file, none))
      throw InputError("the output exists and is of no comparison", file.string(),
                       "expected a new folder, or one with `runs`");
    for (const std::string& input : inputs)
      if (fs::equivalent(input, file, none))
        throw InputError("the results would replace an input", input, "expected another folder with -o");
  }
}

/// A command quoted for the shell.
std::string quoted(const std::vector<std::string>& arguments) {
  std::string command;
  for (std::string argument : arguments) {
    if (argument.empty() || argument.find_first_of(" \t\"'\\$`&;<>()|*?[]#~") != std::string::npos) {
      for (size_t at = 0; (at = argument.find('\'', at)) != std::string::npos; at += 4)
        argument.replace(at, 1, "'\\''");
      argument = "'" + argument + "'";
    }
    command += (command.empty() ? "" : " ") + argument;
  }
  return command;
}

int execute(const CommandLine& line, const std::string& command) {
  check(line);
  warn(run::Configuration(line.files.config, line.settings).warnings);
  std::vector<comparison::Variant> variants;
  for (const std::string& text : line.variants) variants.push_back(comparison::parseVariant(text));
  std::vector<comparison::ParticleCount> particles;
  for (const std::string& text : line.particles) particles.push_back(comparison::parseParticleCount(text));
  if (particles.empty())
    particles = {{"", run::Configuration(line.files.config, line.settings).filter.filter.particles}};
  const std::vector<comparison::Group> groups = comparison::makeGroups(line.methods, variants, particles);
  comparison::GroundTruth truth = loadTruth(line);
  const comparison::CommonSetup common{line.files.config, line.files.log, line.settings};
  const fs::path runs = fs::path(line.output) / "runs";
  const std::vector<comparison::ComparisonRun> sweep =
      comparison::makeSweep(common, groups, comparison::makeRuns(groups.size(), line.firstSeed, line.seeds),
                            runs, besideThisProgram("hybrid-slam"), stop, LogTeller(line));
  const comparison::RunSetup setup = comparison::setupOf(common, groups[0], line.firstSeed);
  const LogSpan log = readLog(line, setup);
  truth.expectOverlap(log.deadReckoning);
  if (line.isListOnly) {
    for (const comparison::ComparisonRun& r : sweep)
      std::cout << r.folder.path().filename().string() << '\t' << quoted(r.command) << '\n';
    return 0;
  }
  if (truth.revisits || truth.plan)
    truth.takeScans(readings::loadEndPoints(line.files.log, setup.configuration().input));
  expectFree(line, variants, runs);
  std::error_code none;
  const files::OutputFolder folder(line.output);
  const FolderLock lock(folder);
  if (fs::exists(runs, none) && !fs::is_directory(runs, none))
    throw InputError("not a folder", runs.string(), "expected the folder of the runs");
  if (!sweep.empty())
    comparison::expectLog(sweep.front().folder.path().parent_path(), sweep.front().identity);

  for (const comparison::ComparisonRun& r : sweep) {
    expectNoStop("folder " + line.output);
    if (!r.folder.isFinished() || line.isReportOnly) continue;
    if (const std::string damaged = r.folder.damage(); !damaged.empty()) {
      warn({"damaged run: " + r.folder.file(damaged).string() + "; it is run again"});
      r.folder.discard();
    }
  }
  size_t ended = 0;
  const auto start = std::chrono::steady_clock::now();
  size_t todo = 0;
  for (const comparison::ComparisonRun& r : sweep) todo += !r.folder.isFinished();
  const auto tell = [&](const comparison::ComparisonRun& r, const std::string& error) {
    ++ended;
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    const auto left =
        static_cast<int>(elapsed.count() / static_cast<double>(ended) * static_cast<double>(todo - ended));
    if (!error.empty())
      std::cerr << "slam-compare: run failed: " << onOneLine(r.folder.path().string() + ": " + error)
                << std::endl;
    if (!line.isQuiet)
      std::cerr << ended << " of " << todo << ": " << r.folder.path().filename().string() << ", about "
                << left / 60 << ":" << (left % 60 < 10 ? "0" : "") << left % 60 << " left" << std::endl;
  };
  comparison::SweepOutcome outcome;
  if (line.isReportOnly) {
    for (const comparison::ComparisonRun& r : sweep) {
      expectNoStop("folder " + line.output);
      if (r.folder.isFinished() && r.folder.damage().empty()) r.folder.expect(r.identity);
    }
  } else {
    const size_t jobs =
        line.jobs > 0 ? static_cast<size_t>(line.jobs) : std::max(1u, std::thread::hardware_concurrency());
    outcome = comparison::runSweep(sweep, jobs, stop, tell);
  }
  if (outcome.isInterrupted)
    return fail(1, "interrupted: folder " + line.output + ", " + std::to_string(outcome.kept + outcome.done) +
                       " of " + std::to_string(sweep.size()) +
                       " runs are finished; the same command continues");

  comparison::ReportInput report{command,
                                 HYBRID_SLAM_VERSION,
                                 line.files.config,
                                 line.files.log,
                                 log.duration,
                                 line.settings,
                                 groups,
                                 {},
                                 {},
                                 std::move(truth),
                                 runs};
  for (const comparison::ComparisonRun& r : sweep) {
    expectNoStop("folder " + line.output);
    report.results.push_back(comparison::evaluateRun(r.run, r.folder, report.truth));
    if (const comparison::RunResult& result = report.results.back();
        result.status == comparison::RunResult::Status::failed &&
        (r.folder.isFinished() || line.isReportOnly))
      warn({"run cannot be evaluated: " + r.folder.path().string() + "; " + result.error});
    if (r.folder.isFinished()) r.folder.dropLargeFiles();
  }
  report.summaries = comparison::groupSummaries(groups.size(), report.results);
  folder.write("results.csv",
               [&](std::ostream& out) { comparison::writeResults(groups, report.results, out); });
  folder.write("summary.csv",
               [&](std::ostream& out) { comparison::writeSummary(groups, report.summaries, out); });
  folder.write("summary.json", [&](std::ostream& out) {
    out << run::jsonText(comparison::summaryJson(groups, report.summaries));
  });
  std::string missing;
  folder.write("report.html", [&](std::ostream& out) { missing = comparison::writeReport(report, out); });
  if (!missing.empty())
    std::cerr << "slam-compare: warning: report.html without plots: " << missing << std::endl;
  if (!line.isQuiet) std::cout << folder.path("report.html") << std::endl;

  size_t failed = 0;
  for (const comparison::RunResult& r : report.results)
    failed += r.status == comparison::RunResult::Status::failed;
  if (failed > 0)
    return fail(1, std::to_string(failed) + " of " + std::to_string(sweep.size()) + " runs failed: folder " +
                       line.output + "; see report.html");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Compares methods over many seeds: tables, plots, report. Manual: doc/slam-compare.md.",
               "slam-compare");
  CommandLine line;
  describe(app, line);
  const auto parseAndExecute = [&] {
    if (const auto code = parse(app, argc, argv)) return *code;
    stopOnSignals();
    std::vector<std::string> command{"slam-compare"};
    command.insert(command.end(), argv + 1, argv + argc);
    line.files.sort();
    files::findInputFiles({&line.reference, &line.relations, &line.odometry, &line.floorplan});
    return execute(line, quoted(command));
  };
  return exitCodeOf(parseAndExecute, [](const std::exception& e) {
    return messageOf(e) + (stop ? "; the same command continues" : "");
  });
}
