#include "run/Replay.h"

#include <cmath>
#include <iostream>
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
  FilterRun run(configuration, start);
  for (const std::string& line : ofLog)
    if (!isQuiet) std::cout << line << "\n" << std::flush;
  run.profiler().enable(wantsProfile);
  readings::RawlogSource source(file, configuration.input, log);
  const auto nextReading = [&] {
    const mrpt::system::CTimeLoggerEntry reading(run.profiler(), "1 read log");
    return source.next();
  };
  if (session) {
    run.resume(*session);
    run.passOver(source, file);
    session.reset();
  }
  Progress progress(log.scans, isQuiet);
  const std::string place = run.folderNote();
  if (!place.empty()) progress.say(place);
  ReplayOutcome outcome;
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
  outcome.summary = run.finish(file, log, nlohmann::ordered_json::object());
  if (const std::string map = run.mapNote(); !map.empty()) outcome.warnings.push_back(map);
  outcome.verdict = run.verdict();
  if (run.folderNote() != place) progress.say(run.folderNote());  // another run has finished there
  for (const std::string& note : run.takeNotes()) progress.say(note);
  if (wantsProfile) outcome.profile = run.profiler().getStatsAsText();
  run.profiler().clear(true);  // else MRPT prints it as well
  return outcome;
}

}  // namespace hybrid_slam::run
