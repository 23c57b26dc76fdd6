#include "run/Replay.h"

#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/Errors.h"
#include "base/Numbers.h"
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

/// A run over the log, with written but unpublished results.
struct Pass {
  std::unique_ptr<FilterRun> run;
  ReplayOutcome outcome;  ///< without the summary
};

Pass map(Configuration& configuration, const readings::RawlogSummary& log, SessionReader* session,
         std::unique_ptr<FilterRun> filterRun, Progress& progress, const std::atomic<bool>& stop) {
  Pass pass{std::move(filterRun), {}};
  FilterRun& run = *pass.run;
  ReplayOutcome& outcome = pass.outcome;
  const std::string& file = configuration.run.rawlog;
  readings::RawlogSource source(file, configuration.input, log);
  const auto nextReading = [&] {
    const mrpt::system::CTimeLoggerEntry reading(run.profiler(), "1 read log");
    return source.next();
  };
  if (session) {
    run.resume(*session);
    run.passOver(source, file);
  }
  const std::string upToHere = "; results cover the log up to this point";
  try {
    while (const auto reading = stop ? std::nullopt : nextReading())
      if (run.process(*reading)) {
        for (const std::string& note : run.takeNotes()) progress.say(note);
        progress.update(run.scans(), spreadNote(run.view().lastStep()));
      }
  } catch (const std::exception& e) {
    if (run.scans() == 0) throw;
    outcome.incomplete = "run failed: " + messageOf(e) + ", " + source.place() + upToHere;
  }
  progress.finish();

  outcome.warnings = readings::warningsOf(log, file);
  if (const std::string slips = run.slipNote(); !slips.empty()) outcome.warnings.push_back(slips);
  if (outcome.incomplete.empty() && stop)
    outcome.incomplete = "interrupted: " + source.place() + upToHere;
  else if (outcome.incomplete.empty() && !log.defect.empty())
    outcome.incomplete = "log " + log.defect + ": " + log.defectPlace(file) + upToHere;
  else if (outcome.incomplete.empty())
    outcome.incomplete = run.placeNote();
  run.writeResults(file, log, {{"second_run", configuration.run.isRetry}});
  if (const std::string coarser = run.mapNote(); !coarser.empty()) outcome.warnings.push_back(coarser);
  outcome.verdict = run.verdict();
  for (const std::string& note : run.takeNotes()) progress.say(note);
  return pass;
}

/// Whether more particles may find the map that this run has lost.
bool isRetryDue(const Pass& pass, const Configuration& c) {
  return pass.outcome.verdict.level == Verdict::Level::lost && pass.outcome.incomplete.empty() &&
         c.run.retryParticles > 0 && c.filter.filter.isAdaptive() && !c.filter.filter.isAuxiliary() &&
         c.run.method != RunOptions::Method::stock && c.run.method != RunOptions::Method::ortho &&
         c.run.localizeIn.empty();
}

}  // namespace

ReplayOutcome replay(Configuration& configuration, bool isQuiet, const std::atomic<bool>& stop,
                     bool wantsProfile) {
  const auto start = FilterRun::Clock::now();
  std::optional<SessionReader> session;
  if (!configuration.run.resume.empty()) adopt(configuration, session.emplace(configuration.run.resume));
  const std::string& file = configuration.run.rawlog;
  const readings::RawlogSummary log = summarise(file, configuration.input);
  const std::vector<std::string> ofLog =
      applyLogSettings(readLogSettings(file, configuration.input, log), configuration);
  auto run = std::make_unique<FilterRun>(configuration, start);
  for (const std::string& line : ofLog)
    if (!isQuiet) std::cout << line << "\n" << std::flush;
  run->profiler().enable(wantsProfile);
  Progress progress(log.scans, isQuiet);
  const std::string place = run->folderNote();
  if (!place.empty()) progress.say(place);
  Pass pass = map(configuration, log, session ? &*session : nullptr, std::move(run), progress, stop);
  session.reset();

  Configuration again = configuration;
  if (isRetryDue(pass, configuration)) {
    const int particles = configuration.run.retryParticles;
    progress.say(pass.outcome.verdict.line());
    progress.say("second run, with " + std::to_string(particles) + " particles");
    again.run.output = pass.run->folder();
    again.run.isRetry = true;
    again.run.resume.clear();
    again.filter.filter.particles = particles;
    try {
      run = std::make_unique<FilterRun>(again, start);
      run->profiler().enable(wantsProfile);
      Progress secondProgress(log.scans, isQuiet);
      Pass second = map(again, log, nullptr, std::move(run), secondProgress, stop);
      if (!second.outcome.incomplete.empty()) throw std::runtime_error(second.outcome.incomplete);
      pass = std::move(second);
    } catch (const std::exception& e) {  // as on a full disk
      pass.outcome.warnings.push_back("no results of a second run: " + messageOf(e));
    }
  }

  ReplayOutcome& outcome = pass.outcome;
  outcome.summary = pass.run->publish();
  if (const std::string now = pass.run->folderNote(); !now.empty() && now != place)
    progress.say(now);  // another run has finished there
  if (wantsProfile) outcome.profile = pass.run->profiler().getStatsAsText();
  pass.run->profiler().clear(true);  // else MRPT prints it as well
  return std::move(outcome);
}

}  // namespace hybrid_slam::run
