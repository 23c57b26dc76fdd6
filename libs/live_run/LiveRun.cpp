#include "live_run/LiveRun.h"

#include <mrpt/obs/CObservationOdometry.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "base/Clock.h"
#include "base/Errors.h"
#include "base/Numbers.h"

namespace hybrid_slam::live {
namespace {

/// The smallest value that at least a share of all values do not exceed (Hyndman & Fan's type 1); 0 without
/// values.
double nearestRankQuantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto rank = static_cast<size_t>(std::ceil(share * static_cast<double>(values.size())));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::max<size_t>(rank, 1) - 1);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

const std::string& recordingName(const LiveOptions& options) {
  if (options.recording.empty() || options.recording.find('/') != std::string::npos)
    throw InputError("wrong name `" + options.recording + "`", "section [live], key `recording`",
                     "expected a file name in the folder for the results");
  return options.recording;
}

}  // namespace

LiveRun::LiveRun(run::Configuration& configuration, const LiveOptions& options, EventLog& log, bool isQuiet)
    : assembler_(readings::labelsOf(configuration.input.sensorLabel),
                 readings::odometrySource(configuration.input, true), configuration.input.maxOdometryGap,
                 readings::sensorSettings(configuration.input, true), configuration.input.odometryTopic),
      configuration_(configuration),
      log_(log),
      isQuiet_(isQuiet),
      run_(configuration),
      recording_(run_.folder(), recordingName(options), log),
      queue_(static_cast<size_t>(options.maxWaiting)),
      mapSoFar_(configuration.filter.grid.maxRange),
      thread_([this] { filter(); }) {
  recording_.keepFree(1e6 * options.diskReserve);
  run_.setBeforeSession([this] { recording_.flush(); });
  if (!run_.folderNote().empty()) log_.report("results", run_.folderNote());
}

LiveRun::~LiveRun() {
  stopFilter(Clock::now());
  run_.finishCheckpoint();  // it uses the recording
}

void LiveRun::take(const mrpt::obs::CSensoryFrame::Ptr& cycle) {
  const auto arrival = Clock::now();
  for (const auto& observation : *cycle) takeObservation(observation, arrival);
}

void LiveRun::takeObservation(const mrpt::obs::CObservation::Ptr& observation, Clock::time_point arrival) {
  recording_.write(*observation);
  if (const auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservation2DRangeScan>(observation))
    reportUse(*scan);
  const auto odometry = std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(observation);
  if (odometry && !hasWrongOdometry_ && !readings::isPossible(odometry->odometry.asTPose())) {
    log_.report("odometry", "not a number, or beyond 1e8 m or 1e6 rad; skipped, as are further ones");
    hasWrongOdometry_ = true;
  }
  const size_t jumps = assembler_.jumps(), dropped = assembler_.dropped();
  assembler_.take(observation);
  if (jumps == 0 && assembler_.jumps() > 0)
    log_.report(
        "odometry",
        "jumps by over 100 m or far above the robot's speed, taken as no motion, as are further ones: " +
            place());
  if (dropped == 0 && assembler_.dropped() > 0)
    log_.report("odometry", "none yet; of the scans before it, the last " +
                                std::to_string(readings::kMostEarly) + " are used");
  while (const auto reading = assembler_.next()) queue_.push(*reading, arrival);
}

void LiveRun::reportUse(const mrpt::obs::CObservation2DRangeScan& scan) {
  const auto use = assembler_.useOf(scan);
  const bool isUsed = use == readings::ScanGrouper::Use::taken;
  auto& told = isUsed ? used_ : ignored_;
  if (told.size() >= readings::kMostLabels || !told.insert(scan.sensorLabel).second) return;
  log_.report("laser `" + scan.sensorLabel + "`",
              isUsed ? "used, " + std::to_string(scan.getScanSize()) + " beams"
                     : "scan not used, as are further ones: " + readings::reasonOf(use) + ": " + place());
}

std::string LiveRun::place() const {
  return "entry " + std::to_string(recording_.entries()) + " of " + recording_.path();
}

void LiveRun::filter() {
  try {
    while (const auto next = queue_.pop()) {
      if (next->skipped > 0) {
        skipped_ += next->skipped;
        tellSkipped();
      }
      run_.skip(next->skipped);
      const bool isUpdate = run_.process(next->reading);
      if (isUpdate && !run_.view().place()) mapSoFar_.add(run_.view(), next->reading.scans);
      tellNotes();
      if (watcher_) watcher_(run_.view(), next->reading, isUpdate);
      latencies_.push_back(1000 * secondsSince(next->arrival));
      if (secondsSince(lastState_) >= stateInterval_) tellState();
    }
  } catch (...) {
    failure_ = std::current_exception();
    hasFailed_ = true;
  }
}

/// Reports twice as many skipped scans each time, so that a filter that is always late does not flood the
/// log.
void LiveRun::tellSkipped() {
  if (skipped_ < 2 * toldSkipped_) return;
  toldSkipped_ = skipped_;
  log_.report("filter", "late: " + counted(skipped_, "scan(s) skipped so far"));
}

void LiveRun::tellNotes() {
  for (const std::string& note : run_.takeNotes()) log_.report("filter", note);
}

void LiveRun::tellState() {
  lastState_ = Clock::now();
  tellVerdict();
  if (isQuiet_) return;
  const FilterStep& step = run_.view().lastStep();
  const auto place = run_.view().place();
  const std::string map = verdict_ ? verdict_->name() : run::Verdict().name();
  log_.report("filter", std::to_string(latencies_.size()) + " scans, " +
                            std::to_string(run_.view().updates()) + " updates, " + std::to_string(skipped_) +
                            " skipped, spread " + fixedText(std::hypot(step.stdX, step.stdY), 2) +
                            " m, latency " + fixedText(latencies_.back(), 0) + " ms" +
                            (place ? ", " + describe(*place) : ", map " + map));
}

// The verdict is found in another thread, so that no scan waits for it. The run does not need it.
void LiveRun::tellVerdict() try {
  if (run_.view().place() || run_.view().updates() == 0) return;
  if (nextVerdict_.valid()) {
    if (nextVerdict_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    auto next = std::make_shared<const run::Verdict>(nextVerdict_.get());
    if (next->level != (verdict_ ? verdict_->level : run::Verdict().level)) log_.report("map", next->line());
    verdict_ = std::move(next);
  }
  if (run_.view().updates() == judged_) return;
  judged_ = run_.view().updates();
  nextVerdict_ = std::async(std::launch::async, mapSoFar_.judge(run_.view()));
} catch (const std::exception& e) {
  log_.report("map", "not judged: " + messageOf(e));
}

void LiveRun::stopFilter(Clock::time_point deadline) {
  if (!thread_.joinable()) return;
  queue_.close(deadline);
  thread_.join();
}

std::string LiveRun::finish(size_t lost, std::optional<double> patience) {
  assembler_.finish();
  while (const auto reading = assembler_.next()) queue_.push(*reading, Clock::now());
  stopFilter(patience ? Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                           std::chrono::duration<double>(*patience))
                      : Clock::time_point::max());
  recording_.finish();
  if (run_.scans() == 0 && failure_) std::rethrow_exception(failure_);
  if (run_.scans() == 0) throw std::runtime_error("no scan with odometry received");

  readings::RawlogSummary recorded;
  try {
    recorded = summarise(recording_.path(), configuration_.input);
    if (configuration_.input.requireOdometry && !recorded.hasOdometryReadings)
      throw InputError("it ends before the first odometry", recording_.path(), "expected a longer recording");
  } catch (const InputError& e) {  // the disk was full from the start, or the recording was removed
    recorded = {};
    log_.report("results", "without those that need the recording (" + messageOf(e) + ")");
  }
  nlohmann::ordered_json more{{"skipped_readings", recorded.skippedReadings()},
                              {"skipped", skipped_.load()},
                              {"lost_cycles", lost},
                              {"latency_ms",
                               {{"median", nearestRankQuantile(latencies_, 0.5)},
                                {"p99", nearestRankQuantile(latencies_, 0.99)},
                                {"max", nearestRankQuantile(latencies_, 1)}}}};
  if (lost > 0)
    log_.report("results", "without " + counted(lost, "cycle(s)") + " of the server that did not arrive");
  if (failure_) more["complete"] = false;
  const run::FinishedRun finished = run_.finish(recording_.path(), recorded, more);
  tellNotes();
  if (!finished.mapNote.empty()) log_.report("results", finished.mapNote);
  if (failure_) {
    log_.report("results", "written up to the failure: " + run_.folder());
    std::rethrow_exception(failure_);
  }
  std::string incomplete = run_.placeNote();
  if (!finished.incomplete.empty()) incomplete = finished.incomplete;
  if (recorded.scans < run_.readings())
    incomplete = "the recording has " + std::to_string(recorded.scans) + " of " +
                 counted(run_.readings(), "scan(s): ") + recording_.path() + "; the map is not refined";
  if (!incomplete.empty()) {
    log_.report("results", finished.summary);
    log_.report("map", finished.verdict.line());
    throw std::runtime_error(incomplete);
  }
  return finished.summary + ", " + recording_.path() + "\n" + finished.verdict.line();
}

}  // namespace hybrid_slam::live
