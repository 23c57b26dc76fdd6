#include "run/Replay.h"

#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "base/Numbers.h"
#include "run/FilterRun.h"
#include "run/LogSettings.h"
#include "run/Progress.h"

namespace hybrid_slam::run {
namespace {

std::vector<std::string> warningsOf(const readings::RawlogSummary& log) {
  std::vector<std::string> all;
  const auto add = [&all, &log](const readings::Oddity& odd, const std::string& what,
                                const std::string& done) {
    if (odd.count > 0)
      all.push_back(std::to_string(odd.count) + " " + what + ": first at " + log.unit + " " +
                    std::to_string(odd.first) + "; " + done);
  };
  add(log.brokenLines, "broken lines", "skipped");
  add(log.empty, "scans without beams (or aperture or sensor pose)", "skipped");
  add(log.tilted, "scans of a tilted plane", "skipped");
  add(log.unstamped, "scans without timestamp", "previous scan's timestamp used");
  add(log.repeatedStamps, "timestamps equal that of the previous scan", "kept");
  add(log.stepsBack, "timestamps step back", "log order kept");
  add(log.wrongOdometry, "odometry readings that are not numbers", "skipped");
  all.insert(all.end(), log.ignored.begin(), log.ignored.end());
  return all;
}

std::string spreadNote(const FilterStep& step) {
  return "spread " + fixedText(std::hypot(step.stdX, step.stdY), 2) + " m";
}

}  // namespace

ReplayOutcome replay(Configuration& configuration, bool isQuiet, const std::atomic<bool>& stop,
                     const std::string& version, bool wantsProfile) {
  const auto start = FilterRun::Clock::now();
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
  Progress progress(log.scans, isQuiet);
  while (const auto reading = stop ? std::nullopt : nextReading())
    if (run.process(*reading)) {
      for (const std::string& note : run.takeLoopNotes()) progress.say(note);
      progress.update(run.scans(), spreadNote(run.view().lastStep()));
    }
  progress.finish();

  ReplayOutcome outcome;
  outcome.warnings = warningsOf(log);
  if (const std::string slips = run.slipNote(); !slips.empty()) outcome.warnings.push_back(slips);
  if (stop)
    outcome.incomplete = "interrupted: " + source.place() + "; results cover the log up to this point";
  else if (!log.defect.empty())
    outcome.incomplete =
        "log " + log.defect + ": " + log.defectPlace(file) + "; results cover the log up to this point";
  outcome.summary = run.finish(file, log, version, nlohmann::ordered_json::object());
  outcome.verdict = run.verdict();
  for (const std::string& note : run.takeLoopNotes()) progress.say(note);
  if (wantsProfile) outcome.profile = run.profiler().getStatsAsText();
  run.profiler().clear(true);  // else MRPT prints it as well
  return outcome;
}

}  // namespace hybrid_slam::run
