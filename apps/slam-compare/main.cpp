/// @file main.cpp
/// @brief slam-compare: runs methods side by side over many seeds; tables, plots, report
/// (doc/slam-compare.md).

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>
#include <thread>

#include "CommandLine.h"
#include "Program.h"
#include "Stop.h"
#include "files/InstalledFiles.h"
#include "files/Locks.h"
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
  double duration = 0;           ///< s
  readings::InputOptions input;  ///< of the runs
};

/// One pass over the log, which finds errors before any run starts.
LogSpan readLog(const CommandLine& line, const comparison::RunSetup& setup) {
  run::Configuration configuration = setup.configuration();
  const readings::RawlogSummary summary =
      readings::summarise(line.files.log, configuration.input, [] { return stop.load(); });
  readings::RawlogSource source(line.files.log, configuration.input, summary);
  run::TrajectoryRecorder recorder;
  while (const auto reading = source.next()) {
    expectNoStop(source.place());
    recorder.add(reading->timestamp, reading->motion, 0);
  }
  run::applyLogSettings(run::readLogSettings(line.files.log, configuration.input, summary), configuration);
  return {recorder.trajectory({}), summary.duration, configuration.input};
}

/// Allows one comparison at a time in a folder.
class FolderLock {
 public:
  explicit FolderLock(const files::OutputFolder& folder)
      : file_(open(folder.path(".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
    if (file_ >= 0 && files::lock(file_) == files::Lock::ofAnother)
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

/// Rejects a file in place of the folder of the runs, and tables that would replace other files.
void expectFree(const CommandLine& line, const std::vector<comparison::Group>& groups, const fs::path& runs) {
  std::vector<std::string> inputs = {line.files.config, line.files.log, line.reference,
                                     line.relations,    line.odometry,  line.floorplan};
  for (const comparison::Group& group : groups) inputs.push_back(group.variant.iniFile);
  std::error_code none;
  if (fs::exists(runs, none) && !fs::is_directory(runs, none))
    throw InputError("not a folder", runs.string(), "expected the folder of the runs");
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

std::vector<comparison::Group> groupsOf(const CommandLine& line) {
  std::vector<comparison::Variant> variants;
  for (const std::string& text : line.variants) variants.push_back(comparison::parseVariant(text));
  std::vector<comparison::ParticleCount> particles;
  for (const std::string& text : line.particles) particles.push_back(comparison::parseParticleCount(text));
  if (particles.empty())
    particles = {{"", run::Configuration(line.files.config, line.settings).filter.filter.particles}};
  return comparison::makeGroups(line.methods, variants, particles);
}

using ComparisonRuns = std::vector<comparison::ComparisonRun>;

/// Discards finished runs whose files are damaged, or expects that they are of this comparison.
void checkFinished(const CommandLine& line, const ComparisonRuns& sweep) {
  if (!sweep.empty())
    comparison::expectLog(sweep.front().folder.path().parent_path(), sweep.front().identity);
  for (const comparison::ComparisonRun& r : sweep) {
    expectNoStop("folder " + line.output);
    if (!r.folder.isFinished()) continue;
    const std::string damaged = r.folder.damage();
    if (line.isReportOnly) {
      if (damaged.empty()) r.folder.expect(r.identity);
    } else if (!damaged.empty()) {
      warn({"damaged run: " + r.folder.file(damaged).string() + "; it is run again"});
      r.folder.discard();
    }
  }
}

/// Says which run ended, why it failed, and how long the others will take.
class Progress {
 public:
  Progress(const ComparisonRuns& sweep, bool isQuiet) : isQuiet_(isQuiet) {
    for (const comparison::ComparisonRun& r : sweep) all_ += !r.folder.isFinished();
  }
  void operator()(const comparison::ComparisonRun& r, const std::string& error) {
    ++ended_;
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
    const auto left =
        static_cast<int>(elapsed.count() / static_cast<double>(ended_) * static_cast<double>(all_ - ended_));
    if (!error.empty())
      std::cerr << "slam-compare: run failed: " << onOneLine(r.folder.path().string() + ": " + error)
                << std::endl;
    if (!isQuiet_)
      std::cerr << ended_ << " of " << all_ << ": " << r.folder.path().filename().string() << ", about "
                << left / 60 << ":" << (left % 60 < 10 ? "0" : "") << left % 60 << " left" << std::endl;
  }

 private:
  bool isQuiet_;
  size_t all_ = 0, ended_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void evaluate(const CommandLine& line, const ComparisonRuns& sweep, comparison::ReportInput& report) {
  for (const comparison::ComparisonRun& r : sweep) {
    expectNoStop("folder " + line.output);
    report.results.push_back(comparison::evaluateRun(r.run, r.folder, report.truth));
    if (const comparison::RunResult& result = report.results.back();
        result.status == comparison::RunResult::Status::failed &&
        (r.folder.isFinished() || line.isReportOnly))
      warn({"run cannot be evaluated: " + r.folder.path().string() + "; " + result.error});
    if (r.folder.isFinished()) r.folder.dropLargeFiles();
  }
  report.summaries = comparison::groupSummaries(report.groups.size(), report.results);
}

void write(const comparison::ReportInput& report, const files::OutputFolder& folder) {
  folder.write("results.csv",
               [&](std::ostream& out) { comparison::writeResults(report.groups, report.results, out); });
  folder.write("summary.csv",
               [&](std::ostream& out) { comparison::writeSummary(report.groups, report.summaries, out); });
  folder.write("summary.json", [&](std::ostream& out) {
    out << run::jsonText(comparison::summaryJson(report.groups, report.summaries));
  });
  std::string missing;
  folder.write("report.html", [&](std::ostream& out) { missing = comparison::writeReport(report, out); });
  if (!missing.empty())
    std::cerr << "slam-compare: warning: report.html without plots: " << missing << std::endl;
}

/// @return the exit code, if Ctrl-C ended the runs
std::optional<int> runAll(const CommandLine& line, const ComparisonRuns& sweep) {
  const size_t jobs =
      line.jobs > 0 ? static_cast<size_t>(line.jobs) : std::max(1u, std::thread::hardware_concurrency());
  const comparison::SweepOutcome outcome =
      comparison::runSweep(sweep, jobs, stop, Progress(sweep, line.isQuiet));
  if (!outcome.isInterrupted) return std::nullopt;
  return fail(1, "interrupted: folder " + line.output + ", " + std::to_string(outcome.kept + outcome.done) +
                     " of " + std::to_string(sweep.size()) +
                     " runs are finished; the same command continues");
}

int execute(const CommandLine& line, const std::string& command) {
  check(line);
  warn(run::Configuration(line.files.config, line.settings).warnings);
  const std::vector<comparison::Group> groups = groupsOf(line);
  comparison::GroundTruth truth = loadTruth(line);
  const comparison::CommonSetup common{line.files.config, line.files.log, line.settings};
  const fs::path runs = fs::path(line.output) / "runs";
  const ComparisonRuns sweep =
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
  if (truth.revisits || truth.plan) truth.takeScans(readings::loadEndPoints(line.files.log, log.input));
  const auto isFinished = [](const comparison::ComparisonRun& r) { return r.folder.isFinished(); };
  if (line.isReportOnly && std::none_of(sweep.begin(), sweep.end(), isFinished))
    throw InputError("no finished run", "folder " + line.output, "expected runs of this command");
  expectFree(line, groups, runs);
  const files::OutputFolder folder(line.output);
  const FolderLock lock(folder);
  checkFinished(line, sweep);
  if (!line.isReportOnly)
    if (const std::optional<int> code = runAll(line, sweep)) return *code;
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
  evaluate(line, sweep, report);
  write(report, folder);
  if (!line.isQuiet) std::cout << folder.path("report.html") << std::endl;

  const auto failed = std::count_if(report.results.begin(), report.results.end(), [](const auto& r) {
    return r.status == comparison::RunResult::Status::failed;
  });
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
