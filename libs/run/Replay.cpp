#include "run/Replay.h"

#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/Errors.h"
#include "base/Numbers.h"
#include "base/Terminal.h"
#include "readings/LogWarnings.h"
#include "run/FilterRun.h"
#include "run/LogSettings.h"
#include "run/Progress.h"
#include "run/Resume.h"

namespace hybrid_slam::run {

namespace {

std::string spreadNote(const FilterStep& step) {
  return "spread " + fixedText(std::hypot(step.stdX, step.stdY), 2) + " m";
}

/// Clears the profiler: MRPT prints the table of one that is destroyed.
struct Silence {
  mrpt::system::CTimeLogger& profiler;
  ~Silence() { profiler.clear(true); }
};

/// Runs over the log once, from the session if there is one. A repeated run that does not reach the end
/// writes no results.
class LogPass {
 public:
  LogPass(Configuration& configuration, const readings::RawlogSummary& log, bool isRepeated, bool isQuiet)
      : configuration_(configuration), log_(log), isRepeated_(isRepeated), progress_(log.scans, isQuiet) {}

  ReplayOutcome operator()(FilterRun& run, SessionReader* session, const std::atomic<bool>& stop,
                           bool wantsProfile) {
    const Silence silence{run.profiler()};
    run.profiler().enable(wantsProfile);
    const std::string place = run.folderNote();
    if (!place.empty()) progress_.say(place);
    ReplayOutcome outcome;
    const std::string& file = configuration_.run.rawlog;
    const std::string cut = process(run, session, stop);
    if (isRepeated_)
      for (const std::string& why : {cut, run.placeNote()})
        if (!why.empty()) throw std::runtime_error(why);
    if (run.scans() == 0 && !cut.empty()) throw std::runtime_error(cut + ", before the first scan");
    outcome.incomplete = cut.empty() ? run.placeNote() : cut + "; results cover the log up to this point";
    if (!cut.empty() && !run.placeNote().empty()) outcome.incomplete += "; " + run.placeNote();
    outcome.warnings = readings::warningsOf(log_, file);
    for (const std::string& warning : run.warnings()) outcome.warnings.push_back(warning);
    const FinishedRun finished = run.finish(file, log_, {{"second_run", isRepeated_}});
    outcome.summary = finished.summary;
    outcome.verdict = finished.verdict;
    if (outcome.incomplete.empty()) outcome.incomplete = finished.incomplete;
    if (!finished.mapNote.empty()) outcome.warnings.push_back(finished.mapNote);
    if (run.folderNote() != place) progress_.say(run.folderNote());  // another run has finished there
    for (const std::string& note : run.takeNotes()) progress_.say(note);
    if (wantsProfile) outcome.profile = run.profiler().getStatsAsText();
    return outcome;
  }

 private:
  /// @return why the run ended before the log; empty if it did not
  std::string process(FilterRun& run, SessionReader* session, const std::atomic<bool>& stop) {
    const std::string& file = configuration_.run.rawlog;
    readings::RawlogSource source(file, configuration_.input, log_);
    const auto nextReading = [&] {
      const mrpt::system::CTimeLoggerEntry reading(run.profiler(), "1 read log");
      return source.next();
    };
    if (session) {
      run.resume(*session);
      run.passOver(source, file);
      progress_.beginAt(run.scans());
    }
    try {
      while (const auto reading = stop ? std::nullopt : nextReading())
        if (run.process(*reading)) {
          for (const std::string& note : run.takeNotes()) progress_.say(note);
          progress_.update(run.scans(), spreadNote(run.view().lastStep()));
        }
    } catch (const std::exception& e) {
      if (run.scans() == 0) throw;
      return "run failed: " + messageOf(e) + ", " + source.place();
    }
    progress_.finish();
    if (stop && run.readings() < log_.scans) return "interrupted: " + source.place();
    if (run.readings() < log_.scans)
      return "log has become shorter while it was read: " + source.place() + ", after " +
             counted(run.readings(), "of " + std::to_string(log_.scans) + " scan(s)");
    return log_.defect.empty() ? "" : "log " + log_.defect + ": " + log_.defectPlace(file);
  }

  Configuration& configuration_;
  const readings::RawlogSummary& log_;
  bool isRepeated_;
  Progress progress_;
};

/// Returns whether a run with more particles may succeed where this one failed.
bool isRetryDue(const ReplayOutcome& outcome, const Configuration& c) {
  const auto method = c.run.method;
  return outcome.verdict.isContradicted && outcome.incomplete.empty() && c.run.retryParticles > 0 &&
         c.filter.filter.isAdaptive() && !c.filter.filter.isAuxiliary() &&
         method != RunOptions::Method::stock && method != RunOptions::Method::ortho &&
         c.run.localizeIn.empty();
}

}  // namespace

ReplayOutcome replay(Configuration& configuration, bool isQuiet, const std::atomic<bool>& stop,
                     bool wantsProfile) {
  const auto start = FilterRun::Clock::now();
  std::optional<SessionReader> session;
  if (!configuration.run.resume.empty()) adopt(configuration, session.emplace(configuration.run.resume));
  const std::string& file = configuration.run.rawlog;
  readings::RawlogSummary log = summarise(file, configuration.input, [&stop] { return stop.load(); });
  const std::vector<std::string> ofLog =
      applyLogSettings(readLogSettings(file, configuration.input, log), configuration);
  log.adapt(file, configuration.input);
  auto run = std::make_unique<FilterRun>(configuration, start);
  for (const std::string& line : ofLog)
    if (!isQuiet) std::cout << onOneLine(line) << "\n" << std::flush;
  ReplayOutcome outcome =
      LogPass(configuration, log, false, isQuiet)(*run, session ? &*session : nullptr, stop, wantsProfile);
  if (!isRetryDue(outcome, configuration)) return outcome;
  if (!configuration.run.resume.empty() && run->hasEarlierMap()) {
    outcome.warnings.push_back("no second run: the session does not hold the map that the run began with");
    return outcome;
  }

  // The results of a run stay until those of a better one replace them.
  Configuration again = configuration;
  again.run.output = run->folder();
  again.run.overwrite = true;
  again.run.resume.clear();
  again.run.checkpointEvery = 0;  // the session there belongs to the first run
  again.filter.filter.particles = configuration.run.retryParticles;
  const std::string particles = counted(static_cast<size_t>(again.filter.filter.particles), "particle(s)");
  int& seed = again.filter.filter.seed;
  session.reset();
  run.reset();
  for (const std::string number : {"second", "third"}) {
    if (!isRetryDue(outcome, configuration)) break;
    if (number == "third") seed = seed == std::numeric_limits<int>::max() ? 0 : seed + 1;
    std::cerr << outcome.verdict.line() + "\n" + number + " run, with " + particles + " and seed " +
                     std::to_string(seed) + "; results so far: " + again.run.output + "\n";
    try {
      FilterRun next(again, start);
      next.expectVerdict(outcome.verdict);
      outcome = LogPass(again, log, true, isQuiet)(next, nullptr, stop, wantsProfile);
    } catch (const WorseMap& e) {
      outcome.warnings.push_back("no results of a " + number + " run: " + e.what());
    } catch (const std::exception& e) {
      outcome.warnings.push_back("no results of a " + number + " run: " + messageOf(e));
      break;
    }
  }
  return outcome;
}

}  // namespace hybrid_slam::run
