/// @file FilterRun.h
/// @brief A filter and its result files, for a log or a live robot.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "files/StagedFolder.h"
#include "readings/RawlogSource.h"
#include "run/Configuration.h"
#include "run/PathCovariance.h"
#include "run/SessionFile.h"
#include "run/TrajectoryRecorder.h"
#include "run/Verdict.h"
#include "slam/filter/HybridFilter.h"
#include "slam/filter/ScanOdometry.h"
#include "slam/localization/PlanSearch.h"

namespace hybrid_slam::run {

/// Writes steps.csv (and particles.csv) during the run, and the other files of doc/results.md at the end.
/// They appear together (files/StagedFolder.h); without `finish` no results remain but the last checkpoint.
class FilterRun {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param configuration  must outlive the run
  /// @param start          start of `wall_s`
  /// @throws InputError for settings the filter rejects, a wrong map of an earlier run, or an output folder
  ///         that cannot be written
  explicit FilterRun(Configuration& configuration, Clock::time_point start = Clock::now());
  ~FilterRun();

  /// Passes one reading to the filter. Until the place in the map of an earlier run or in a floor plan is
  /// found, it also goes to the search for this place, and the filter maps in its own frame.
  /// @return true for an update of the filter, false if only the odometry was accumulated
  bool process(const readings::Reading& reading);
  /// Goes on where a session ended, before the first reading. The configuration must be its (`adopt`).
  /// @throws InputError for a session of another method, or not of this program
  void resume(SessionReader& session);
  /// The state of the run as bytes. Empty for MRPT's filter, in a fixed map, and while a start is searched
  /// for: these have none.
  std::string state();
  /// Goes on from `state` of a run with this configuration, before the first reading.
  void restore(const std::string& state);
  /// Passes over the readings that the session has processed.
  /// @throws InputError if the log does not begin with them
  void passOver(readings::RawlogSource& source, const std::string& log);
  /// Marks the next `readings` of the log as skipped; the motion of the following one includes theirs.
  void skip(size_t readings) { uses_.resize(uses_.size() + readings, Use::skipped); }

  /// Has the next call of `process` save the map and the session to a dated subfolder, from any thread. A
  /// note names it, or why it could not be written.
  void requestSave() { isSaveRequested_ = true; }
  /// Writes map, trajectory and session as they are now; the run goes on.
  /// @param folder  created if missing
  /// @throws InputError if it cannot be written; std::runtime_error while the start is searched for
  void saveMapTo(const std::string& folder);
  /// Called before each session is written. What it was given must be on disk to resume from the session.
  void setBeforeSession(std::function<void()> action) { beforeSession_ = std::move(action); }
  /// Whether the filter continues an earlier map or began with a floor plan, of this run or the one that is
  /// resumed.
  bool hasEarlierMap() const { return hybrid_ && hybrid_->base(); }
  /// One line if the place in the map of an earlier run has not been found; else empty.
  std::string placeNote() const;

  size_t scans() const { return scans_; }  ///< processed
  /// One line on the updates with rejected odometry; empty if there were none.
  std::string slipNote() const;
  /// One line if the map of the finished run has coarser cells than the filter's; else empty.
  std::string mapNote() const;
  /// What has happened since the last call, a line each: loops closed (where, by how much, on what evidence),
  /// the start found in a map, maps saved.
  std::vector<std::string> takeNotes() { return std::exchange(notes_, {}); }
  /// The filter; while the start in the map of an earlier run is searched for, that search.
  const FilterView& view() const { return search_ ? static_cast<const FilterView&>(*search_) : *filter_; }
  /// The times of the stages; enable it before the first scan. Changes no result.
  mrpt::system::CTimeLogger& profiler() { return filter_->profiler(); }
  /// Where the results will be.
  const std::string& folder() const { return staged_.folder(); }
  /// One line if that is not the folder asked for; else empty.
  std::string folderNote() const { return staged_.note(); }

  /// Writes the results.
  /// @param file     the processed log, read again for map.simplemap.gz, the verdict and the refinement
  /// @param log      its summary; if shorter than what was processed (a recording on a full disk),
  ///                 these end there
  /// @param more     further keys of metrics.json
  /// @return one line: scans, updates, time, real-time factor, place of the results
  /// @throws InputError if a result cannot be written
  std::string finish(const std::string& file, const readings::RawlogSummary& log,
                     const nlohmann::ordered_json& more);
  /// The verdict on the map of the finished run.
  const Verdict& verdict() const { return verdict_; }

 private:
  struct Result {
    files::Trajectory trajectory;
    std::vector<mrpt::math::TPose2D> path;
    mrpt::maps::COccupancyGridMap2D grid;
    std::vector<DatabaseLine> lines;
    ScanMap map;  ///< of our filters: the same grid and lines
  };
  template <class State>
  void visit(State& state);
  bool filter(const readings::Reading& reading);
  void searchPlace(const readings::Reading& reading);
  void searchPlan(const readings::Reading& reading);
  Verdict verdictOfLocalization() const;
  nlohmann::ordered_json metrics(const Result& result, const readings::RawlogSummary& log) const;
  void writeCovarianceFile(const Result& result, const std::vector<PoseCovariance>& covariances);
  ScanMap currentMap() const;  ///< of a method with lines
  void writeMap(const Result& result, const std::string& file, const readings::RawlogSummary& log);
  void writeState(StateWriter& out);
  void saveSessionTo(const std::string& path, const ScanMap& map,
                     const std::vector<mrpt::math::TPose2D>& poses);
  void saveToDatedFolder();
  void saveIfDue();
  /// The row of steps.csv and the counters of an update.
  void record(double timestamp, Clock::time_point stepStart);
  void note(const LoopClosure& loop);
  /// Closes the loops that are left open, matches the scans of the log to the map and rebuilds it.
  void refineResult(Result& result, readings::RawlogSource& source);

  Configuration& configuration_;
  Clock::time_point start_;
  files::StagedFolder staged_;
  const files::OutputFolder& folder_;  ///< of staged_
  std::unique_ptr<Filter> filter_;
  HybridFilter* hybrid_ = nullptr;            ///< filter_, if it is ours
  Localizer* localizer_ = nullptr;            ///< filter_, if it localises
  std::optional<ScanMap> earlierMap_;         ///< to map on in, until the place in it is found
  std::unique_ptr<Localizer> search_;         ///< for this place
  std::unique_ptr<PlanSearch> planSearch_;    ///< for the place in a floor plan
  std::optional<ScanOdometry> scanOdometry_;  ///< in place of odometry
  files::GrowingFile steps_;
  std::optional<files::GrowingFile> particles_;
  TrajectoryRecorder recorder_;
  enum class Use { skipped, carried, update };
  std::vector<Use> uses_;                            ///< per reading of the log
  std::vector<double> updateTimes_;                  ///< s
  std::vector<PoseCovariance> particleCovariances_;  ///< of each update
  std::vector<std::string> notes_;
  std::atomic<bool> isSaveRequested_{false};
  std::function<void()> beforeSession_ = [] {};
  Clock::time_point lastCheckpoint_ = Clock::now();
  uint32_t fingerprint_ = 0;  ///< of the processed readings
  double secondsBefore_ = 0;  ///< wall time of the run that is resumed
  size_t scans_ = 0, resamplings_ = 0, slips_ = 0, loops_ = 0;
  size_t particlesMin_ = 0, particlesMax_ = 0;
  size_t located_ = 0, lostAgain_ = 0;  ///< localisation: updates with a known place; times it was lost
  bool wasLocated_ = false;             ///< at the last update
  double firstSlip_ = 0;                ///< s
  double cell_;                         ///< m, of the filter
  double savedCell_ = 0;                ///< m, of the map files
  Verdict verdict_;
};

}  // namespace hybrid_slam::run
