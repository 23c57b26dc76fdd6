#include "window/view/ReplaySession.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "base/Errors.h"
#include "base/Numbers.h"
#include "files/StagedFolder.h"
#include "readings/LogWarnings.h"
#include "window/view/ReplayPass.h"

namespace hybrid_slam::window {
namespace {

using State = ReplaySnapshot::State;
using Clock = ReplayPass::Clock;

/// Interval between snapshots during a replay: copying the grids takes time from the filters.
constexpr auto kPictureInterval = std::chrono::milliseconds(80);
constexpr size_t kReplayEvents = 200;

}  // namespace

std::vector<run::RunOptions::Method> comparedMethods(const run::Configuration& configuration) {
  using Method = run::RunOptions::Method;
  const Method chosen = configuration.run.method;
  return {Method::hybrid, chosen == Method::hybrid ? Method::general : chosen};
}

ReplaySession::ReplaySession(const run::Configuration& configuration, const std::vector<Method>& methods)
    : configuration_(configuration.alone()), methods_(methods), thread_([this] { work(); }) {}

ReplaySession::~ReplaySession() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    isClosing_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void ReplaySession::play() {
  const std::lock_guard<std::mutex> lock(mutex_);
  startPlaying();
}

void ReplaySession::pause() {
  const std::lock_guard<std::mutex> lock(mutex_);
  goal_ = Goal::pause;
  wake_.notify_all();
}

void ReplaySession::playOrPause() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (goal_ == Goal::pause) return startPlaying();
  goal_ = Goal::pause;
  wake_.notify_all();
}

void ReplaySession::startPlaying() {
  goal_ = Goal::play;
  const State state = snapshot()->state;
  if (state == State::ended || state == State::failed) restartFrom(0);
  wake_.notify_all();
}

void ReplaySession::step() {
  const std::lock_guard<std::mutex> lock(mutex_);
  reach(goingTo() + 1);
}

void ReplaySession::stepBack() {
  const std::lock_guard<std::mutex> lock(mutex_);
  const size_t from = goingTo();
  if (from > 0) reach(from - 1);
}

void ReplaySession::seek(size_t scan) {
  const std::lock_guard<std::mutex> lock(mutex_);
  reach(scan);
}

/// Returns the scan that a step counts from, so that steps in quick succession add up.
size_t ReplaySession::goingTo() const { return goal_ == Goal::reach ? target_ : scans_; }

void ReplaySession::reach(size_t scan) {
  goal_ = Goal::reach;
  target_ = scan;
  if (snapshot()->state == State::failed) restartFrom(0);
  wake_.notify_all();
}

void ReplaySession::restartFrom(size_t scan) {
  wantsRestart_ = true;
  restartAt_ = scan;
}

void ReplaySession::setSpeed(double factor) {
  const std::lock_guard<std::mutex> lock(mutex_);
  speed_ = factor;
  wake_.notify_all();
}

void ReplaySession::exportResults(const std::string& folder) {
  const std::lock_guard<std::mutex> lock(mutex_);
  exportTo_ = folder;
  wake_.notify_all();
}

void ReplaySession::saveMap(const std::string& folder) {
  const std::lock_guard<std::mutex> lock(mutex_);
  saveTo_ = folder;
  wake_.notify_all();
}

void ReplaySession::work() {
  for (;;) {
    try {
      runPass();
    } catch (const std::exception& e) {
      std::unique_lock<std::mutex> lock(mutex_);
      do {  // there is nothing to export or save
        exportTo_.reset(), saveTo_.reset();
        tell(messageOf(e), true, State::failed);
        wake_.wait(lock, [this] { return isClosing_ || wantsRestart_ || exportTo_ || saveTo_; });
      } while (!isClosing_ && !wantsRestart_);
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    if (isClosing_) return;
    wantsRestart_ = false;
  }
}

void ReplaySession::readLog() {
  const std::string& file = configuration_.run.rawlog;
  readings::RawlogSummary summary = summarise(file, configuration_.input, [this] {
    const std::lock_guard<std::mutex> lock(mutex_);
    return isClosing_;
  });
  const auto ofLog =
      std::make_shared<const run::LogSettings>(run::readLogSettings(file, configuration_.input, summary));
  for (const std::string& line : applyLogSettings(*ofLog, configuration_)) event(line);
  summary.adapt(file, configuration_.input);
  for (const std::string& warning : configuration_.warnings) note("warning: " + warning);
  for (const std::string& warning : readings::warningsOf(summary, file)) note("warning: " + warning);
  snapshot_.change([&](ReplaySnapshot& next) { next.ofLog = ofLog; });
  log_ = std::move(summary);
}

void ReplaySession::runPass() {
  if (!log_) readLog();
  const auto* const from = checkpoints_.upTo(std::exchange(restartAt_, 0));
  ReplayPass pass(configuration_, methods_, *log_, from);
  if (!from) ++runs_;
  publish(pass, State::paused, false);
  if (!pass.log.defect.empty())
    tell(
        "log " + pass.log.defect + ": " + pass.log.defectPlace(pass.file) + "; the replay ends at this entry",
        true, State::paused);
  while (hasWork(pass)) {
    try {
      advance(pass);
    } catch (const std::exception& e) {
      if (pass.scans == 0) throw;
      pass.hasFailed = true;
      publish(pass, State::ended, true);
      tell("run failed: " + messageOf(e) + ", " + pass.source.place() +
               "; the results up to this point can be exported",
           true, State::ended);
    }
  }
}

/// Waits until the next scan is due. @return false to abort this pass
bool ReplaySession::hasWork(ReplayPass& pass) {
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    scans_ = pass.scans;
    if (goal_ == Goal::reach && mustJump(pass)) restartFrom(target_);
    if (isClosing_ || wantsRestart_) return false;
    if (saveTo_) {
      const std::string folder = *std::exchange(saveTo_, std::nullopt);
      lock.unlock();
      savePass(pass, folder);
      lock.lock();
      continue;
    }
    if (exportTo_) {
      const std::string folder = *std::exchange(exportTo_, std::nullopt);
      goal_ = Goal::pause;
      lock.unlock();
      exportPass(pass, folder);
      lock.lock();
      continue;
    }
    if (pass.isOver() || (goal_ == Goal::reach && target_ == pass.scans)) goal_ = Goal::pause;
    if (goal_ == Goal::reach) return true;
    if (goal_ == Goal::play && waitUntilDue(lock, pass)) return true;
    if (goal_ != Goal::pause) continue;

    const State state = pass.isOver() ? State::ended : State::paused;
    if (pass.isOutdated || snapshot()->state != state) {
      lock.unlock();
      publish(pass, state, true);
      lock.lock();
    } else {
      wake_.wait(lock);
    }
  }
}

/// Returns whether a new pass is needed: to go back, to continue after an export, or to use a checkpoint
/// ahead.
bool ReplaySession::mustJump(const ReplayPass& pass) const {
  if (target_ <= pass.scans) return target_ < pass.scans;
  const auto* const ahead = checkpoints_.upTo(target_);
  return pass.isFinished() || (ahead && ahead->first > pass.scans + checkpoints_.every());
}

/// @return whether the scan is due; otherwise there was a request, or the maps were published
bool ReplaySession::waitUntilDue(std::unique_lock<std::mutex>& lock, ReplayPass& pass) {
  if (speed_ <= 0) return true;
  // Skip pauses in the log.
  const double gap = std::clamp(pass.next->timestamp - pass.start - pass.time, 0.0, 2.0);
  const auto due = pass.lastScan +
                   std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(gap / speed_));
  if (Clock::now() >= due) return true;
  if (pass.isOutdated) {
    lock.unlock();
    publish(pass, State::playing, true);
    lock.lock();
    return false;
  }
  return wake_.wait_until(lock, due) == std::cv_status::timeout && goal_ == Goal::play && !isClosing_ &&
         !wantsRestart_;
}

void ReplaySession::advance(ReplayPass& pass) {
  for (const std::string& text : pass.advance()) note(text);
  if (checkpoints_.isDue(pass.scans))
    if (auto checkpoint = pass.checkpoint()) checkpoints_.add(pass.scans, std::move(*checkpoint));
  // The scan that is shown is always that of the maps.
  const bool isDue = Clock::now() - pass.lastPicture >= kPictureInterval;
  if (isDue || !pass.isOutdated) publish(pass, State::playing, pass.isOutdated);
}

void ReplaySession::exportPass(ReplayPass& pass, const std::string& folder) {
  try {
    if (pass.scans == 0)
      throw InputError("no results yet", "before the first scan", "play or step the log first");
    files::StagedFolder staged(folder, pass.names(), false);
    std::string incomplete;
    for (const auto& lane : pass.lanes) {
      const std::string name = nameOf(lane->configuration.run.method);
      const std::string why = lane->finish(pass.file, pass.log, staged.finalPath(name));
      std::filesystem::copy(pass.folder.path(name), staged.files().path(name));
      if (!why.empty()) incomplete = "; " + why;
    }
    staged.publish();
    for (const auto& lane : pass.lanes)
      if (const std::string place = lane->run.placeNote(); !place.empty()) note(place);
    tell("Results of " + counted(pass.scans, "scan(s) written: ") + staged.folder() + incomplete,
         !incomplete.empty(), State::ended);
  } catch (const std::exception& e) {
    tell(messageOf(e), true, pass.isOver() ? State::ended : State::paused);
  }
}

void ReplaySession::savePass(ReplayPass& pass, const std::string& folder) {
  try {
    if (pass.scans == 0)
      throw InputError("no map yet", "before the first scan", "play or step the log first");
    if (pass.isFinished())
      throw InputError("the replay has ended", "its results are exported", "play it again to save a map");
    files::StagedFolder staged(folder, pass.names(), false);
    for (const auto& lane : pass.lanes) {
      const std::string name = nameOf(lane->configuration.run.method);
      lane->configuration.run.output = staged.finalPath(name);  // for a run that is resumed from the session
      lane->run.saveMapTo(staged.files().path(name));
    }
    staged.publish();
    note("map saved: " + staged.folder());
  } catch (const std::exception& e) {
    tell(messageOf(e), true, snapshot()->state);
  }
}

void ReplaySession::event(const std::string& text) {
  snapshot_.change([&](ReplaySnapshot& next) {
    next.events.push_back(text);
    if (next.events.size() > kReplayEvents) next.events.erase(next.events.begin());
  });
}

void ReplaySession::note(const std::string& text) {
  event(text);
  snapshot_.change([&](ReplaySnapshot& next) { next.note = text; });
}

void ReplaySession::publish(ReplayPass& pass, State state, bool withMaps) {
  if (withMaps && pass.scans > 0) {
    pass.pictures.clear();
    for (const auto& lane : pass.lanes)
      pass.pictures.push_back(lane->watch.snapshot(lane->run.view(), state != State::playing));
    pass.lastPicture = Clock::now();
  }
  if (withMaps) pass.isOutdated = false;
  snapshot_.change([&](ReplaySnapshot& next) {
    next.state = state;
    next.scans = pass.scans;
    next.total = pass.log.scans;
    next.time = pass.time;
    next.run = runs_;
    next.filters = pass.pictures;
    next.filters.resize(methods_.size());
  });
}

void ReplaySession::tell(const std::string& message, bool isError, State state) {
  snapshot_.change([&](ReplaySnapshot& next) {
    next.state = state;
    next.message = message;
    next.isError = isError;
    ++next.messages;
  });
}

}  // namespace hybrid_slam::window
