// Saves a run and continues it.
#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "base/Clock.h"
#include "base/Errors.h"
#include "base/Numbers.h"
#include "files/DatedName.h"
#include "files/PartialFile.h"
#include "readings/Timestamps.h"
#include "run/FilterRun.h"
#include "run/Fingerprint.h"
#include "run/MapFiles.h"
#include "run/PlanFiles.h"
#include "run/ResultFiles.h"
#include "slam/grid/GridConversion.h"

namespace hybrid_slam::run {
namespace {

/// Writes the rows of a table to a session, or continues the table from it.
template <class State>
void visitTable(State& state, std::ostringstream& table) {
  std::string text = table.str();
  state(text);
  if (!State::kIsReading) return;
  table.str("");
  table << text;
}

/// Returns whether the readings up to this one have a fingerprint. Where the log ended with the scans of some
/// lasers, a grown log has those of the others in the same reading.
bool isLast(const readings::Reading& reading, uint32_t before, uint32_t fingerprint) {
  readings::Reading first;
  for (const auto& scan : reading.scans) {
    first.scans.push_back(scan);
    first.timestamp = readings::isStamped(*scan) ? readings::seconds(scan->timestamp) : reading.timestamp;
    if (fingerprintAfter(before, first) == fingerprint) return true;
  }
  return fingerprintAfter(before, reading) == fingerprint;
}

InputError otherLog(const std::string& log) {
  return {"another log than the session's", log, "expected one that begins with the readings of the session"};
}

}  // namespace

/// Visits the filter first, so that it can be read alone.
template <class State>
void FilterRun::visit(State& state) {
  if constexpr (State::kIsReading)
    hybrid_->load(state);
  else
    hybrid_->save(state);
  state(fingerprint_, secondsBefore_, scans_, counts_, recorder_, uses_, particleCovariances_);
  visitTable(state, steps_);
  bool hasParticles = particles_.has_value(), hasScanOdometry = scanOdometry_.has_value();
  state(hasParticles, hasScanOdometry);
  state.check(hasParticles == particles_.has_value() && hasScanOdometry == scanOdometry_.has_value(),
              "it does not belong to its configuration");
  if (particles_) visitTable(state, *particles_);
  if (scanOdometry_) state(*scanOdometry_);
  size_t processed = 0, updates = 0;
  for (const ReadingUse use : uses_) {
    state.check(use == ReadingUse::skipped || use == ReadingUse::carried || use == ReadingUse::update,
                "a reading has no use");
    processed += use != ReadingUse::skipped;
    updates += use == ReadingUse::update;
  }
  state.check(processed == scans_ && recorder_.updates().size() == scans_ && updates == hybrid_->updates() &&
                  (scans_ == 0 || recorder_.updates().back() == updates) && updateTimes_.size() == updates &&
                  particleCovariances_.size() == updates,
              "its readings do not belong to its path");
  if (stuckOdometry_) state(counts_.stuckScans, counts_.firstStuck, *stuckOdometry_);
  auto place = static_cast<uint8_t>(place_);
  state(place);
  state.check(place <= static_cast<uint8_t>(PlaceInMap::notFound), "the place in the map has no state");
  place_ = static_cast<PlaceInMap>(place);
}

std::string FilterRun::sessionWith(const ScanMap& map, const std::vector<mrpt::math::TPose2D>& poses) {
  std::string bytes;
  if (!isConsistent_) {
    notes_.emplace_back("no session: the filter failed inside an update");
    return bytes;
  }
  const double most = std::min(static_cast<double>(kMostSessionBytes), sessionBytes_);
  try {
    StateWriter out(bytes, static_cast<size_t>(most));
    SessionHeader header{HYBRID_SLAM_VERSION, configuration_.text(), map, poses, updateTimes_};
    writeHeader(out, header);
    writeState(out);
  } catch (const std::length_error&) {
    notes_.push_back("no session: over " + fixedText(most / 1e9, 1) + " GB");
    bytes.clear();
  }
  return bytes;
}

void FilterRun::saveSessionTo(const std::string& path, const ScanMap& map,
                              const std::vector<mrpt::math::TPose2D>& poses) {
  beforeSession_();
  const std::string bytes = sessionWith(map, poses);
  if (!bytes.empty()) saveSession(path, bytes);
}

void FilterRun::writeState(StateWriter& out) {
  const double before = secondsBefore_;
  secondsBefore_ += secondsSince(start_);
  visit(out);
  secondsBefore_ = before;
}

std::string FilterRun::state() {
  std::string bytes;
  if (!hybrid_ || search_) return bytes;
  StateWriter out(bytes);
  out(updateTimes_);
  writeState(out);
  return bytes;
}

void FilterRun::restore(const std::string& state) {
  StateReader in(state);
  in(updateTimes_);
  visit(in);
  search_.reset();
}

/// Begins a checkpoint if one is due and none is being written. Next to the results of another run, which
/// `finish` may replace, the checkpoint has a separate name, so that a killed run leaves them unchanged.
void FilterRun::saveIfDue() {
  try {
    if (isSaveRequested_.exchange(false)) saveToDatedFolder();
  } catch (const std::exception& e) {
    notes_.push_back("map not saved: " + messageOf(e));
  }
  if (checkpoint_.valid()) {
    if (checkpoint_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    finishCheckpoint();
  }
  const double every = configuration_.run.checkpointEvery;
  if (every <= 0 || !hybrid_ || search_ || secondsSince(lastCheckpoint_) < every) return;
  lastCheckpoint_ = Clock::now();
  try {
    staged_.follow();
    const bool isBeside = staged_.isOfAnother(kSessionName) || staged_.isOfAnother(kResultFiles.back());
    checkpointName_ = isBeside ? kCheckpointName : kSessionName;
    checkpoint_ =
        std::async(std::launch::async, [path = staged_.finalPath(checkpointName_), before = beforeSession_,
                                        bytes = sessionWith(hybrid_->bestMap(), hybrid_->bestPath())] {
          if (bytes.empty()) return;
          before();
          saveSession(path, bytes);
        });
  } catch (const std::exception& e) {
    notes_.push_back("no checkpoint: " + messageOf(e));
  }
}

// A full disk must not end the run.
void FilterRun::finishCheckpoint() {
  if (checkpoint_.valid()) try {
      checkpoint_.get();
      staged_.follow();  // the checkpoint has moved with its folder
      staged_.setOwn(checkpointName_);
    } catch (const std::exception& e) {
      notes_.push_back("no checkpoint: " + messageOf(e));
    }
}

void FilterRun::saveToDatedFolder() {
  if (search_) throw std::runtime_error(placeNote());
  staged_.follow();
  namespace fs = std::filesystem;
  const auto saved = [this](const std::string& date) { return staged_.finalPath("saved-" + date); };
  const auto hidden = [this](const std::string& date) {
    return staged_.finalPath(".saved-" + date + ".part");
  };
  const std::string name = files::claimDatedName([&](const std::string& date) {
    return !fs::exists(fs::symlink_status(saved(date))) && fs::create_directory(hidden(date));
  });
  try {
    saveMapTo(hidden(name));
    fs::rename(hidden(name), saved(name));
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(hidden(name), ignored);
    throw;
  }
  notes_.push_back("map saved: " + saved(name));
}

void FilterRun::saveMapTo(const std::string& path) {
  if (search_) throw std::runtime_error(placeNote());
  const files::OutputFolder folder(path);
  const auto grid = filter_->bestGrid();
  const auto trajectory = recorder_.trajectory(filter_->bestPath());
  const auto lines = filter_->bestLines();
  folder.write("trajectory.tum", [&](std::ostream& out) { files::saveTum(trajectory, out); });
  savePicture(folder, grid, trajectory, lines);
  saveRosMap(folder, grid, trajectory);
  saveLines(folder, lines);
  if (configuration_.filter.useLines && !localizer_) savePlan(folder, floorPlanOf(lines, currentMap().grid));
  if (!hybrid_) return;
  const ScanMap map = hybrid_->bestMap();
  saveSessionTo(folder.path(kSessionName), map, hybrid_->bestPath());
}

ScanMap FilterRun::currentMap() const {
  if (hybrid_) return hybrid_->bestMap();
  return {fromMrpt(filter_->bestGrid()), LineDatabase(filter_->bestLines())};
}

void FilterRun::resume(SessionReader& session) {
  if (!hybrid_)
    throw InputError("method " + nameOf(configuration_.run.method) + " has no sessions", session.file(),
                     "expected method hybrid, general or linemap");
  updateTimes_ = session.header().times;
  session.readRest([this](StateReader& in) { visit(in); });
  if (place_ == PlaceInMap::searched)
    throw InputError("the run had not found its place in the earlier map or floor plan", session.file(),
                     "expected a session of a placed run; this one can be the map of --continue");
  files::PartialFile::removeLeft(session.file());  // what a killed run leaves of its next checkpoint
}

void FilterRun::passOver(readings::RawlogSource& source, const std::string& log) {
  uint32_t before = 0, found = 0;
  std::optional<readings::Reading> last;
  for (const ReadingUse use : uses_) {
    const auto reading = source.next();
    if (!reading) throw otherLog(log);
    if (use == ReadingUse::skipped) continue;
    before = std::exchange(found, fingerprintAfter(found, *reading));
    last = reading;
  }
  if (found != fingerprint_ && !(last && isLast(*last, before, fingerprint_))) throw otherLog(log);
  fingerprint_ = found;
}

}  // namespace hybrid_slam::run
