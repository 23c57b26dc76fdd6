/// @file FilterRun.h
/// @brief A filter and its result files, for a log or a live robot.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "files/StagedFolder.h"
#include "readings/RawlogSource.h"
#include "run/Configuration.h"
#include "run/LogAgain.h"
#include "run/PathCovariance.h"
#include "run/SessionFile.h"
#include "run/TrajectoryRecorder.h"
#include "run/Verdict.h"
#include "slam/filter/HybridFilter.h"
#include "slam/filter/ScanOdometry.h"
#include "slam/filter/StuckOdometry.h"
#include "slam/localization/Localizer.h"
#include "slam/localization/PlanSearch.h"

namespace hybrid_slam::run {

/// The map of a run is worse than that of another run over the log.
struct WorseMap : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Writes the files of doc/results.md at the end. They appear together (files/StagedFolder.h); without
/// `finish` no results remain but the last checkpoint.
class FilterRun {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param configuration  must outlive the run
  /// @param start          start of `wall_s`
  /// @throws InputError for settings the filter rejects, a wrong map of an earlier run, or an output folder
  ///         that cannot be written
  explicit FilterRun(Configuration& configuration, Clock::time_point start = Clock::now());
  ~FilterRun();

  /// Passes one reading to the filter. Until the place in an earlier map or a floor plan is found, the
  /// reading is also passed to that search, and the filter maps in a separate frame.
  /// @return true for an update of the filter, false if only the odometry was accumulated
  /// @throws std::runtime_error after the reading, if the program takes more memory than it may
  bool process(const readings::Reading& reading);
  /// Resumes a session, before the first reading. The configuration must be that of the session (`adopt`).
  /// @throws InputError for a session of another method, or not of this program
  void resume(SessionReader& session);
  /// Returns the state of the run as bytes. Empty for `stock` and `ortho`, in a fixed map, and during the
  /// search for the start.
  std::string state();
  /// Continues from the `state` of a run with this configuration, before the first reading.
  void restore(const std::string& state);
  /// Skips the readings that the session has processed.
  /// @throws InputError if the log does not begin with them
  void passOver(readings::RawlogSource& source, const std::string& log);
  /// Marks the next `readings` of the log as skipped; the motion of the following one includes theirs.
  void skip(size_t readings) { uses_.resize(uses_.size() + readings, Use::skipped); }

  /// Makes the next call of `process` save the map and the session to a dated subfolder. Thread-safe. A note
  /// names the folder, or the reason for a failure.
  void requestSave() { isSaveRequested_ = true; }
  /// Writes the current map, trajectory and session; the run continues.
  /// @param folder  created if missing
  /// @throws InputError if it cannot be written; std::runtime_error during the search for the start
  void saveMapTo(const std::string& folder);
  /// Sets an action to call before each session is written: to resume from it, all readings so far must be on
  /// disk. Checkpoints call it in another thread.
  void setBeforeSession(std::function<void()> action) { beforeSession_ = std::move(action); }
  /// Waits for the checkpoint that is being written.
  void finishCheckpoint();
  /// Returns whether this run, or the resumed one, continues an earlier map or began with a floor plan.
  bool hasEarlierMap() const { return hybrid_ && hybrid_->base(); }
  /// Says in one line that the place in the earlier map has not been found; else empty.
  std::string placeNote() const;

  size_t scans() const { return scans_; }           ///< processed
  size_t readings() const { return uses_.size(); }  ///< of the log, processed or skipped
  /// One line on the updates with rejected odometry; empty if there were none.
  std::string slipNote() const;
  /// One line on the scans during which the odometry was stuck; empty if there were none.
  std::string stuckNote() const;
  /// One line if the map of the finished run has coarser cells than the filter's; else empty.
  std::string mapNote() const;
  /// Returns the events since the last call, one line each: loops closed (where, by how much, on what
  /// evidence), start found in a map, maps saved.
  std::vector<std::string> takeNotes() { return std::exchange(notes_, {}); }
  /// Returns the filter; during the search for the start in an earlier map, that search.
  const FilterView& view() const { return search_ ? static_cast<const FilterView&>(*search_) : *filter_; }
  /// Returns the profiler of the stages; enable it before the first scan. It does not change the results.
  mrpt::system::CTimeLogger& profiler() { return filter_->profiler(); }
  /// Returns the folder of the results.
  const std::string& folder() const { return staged_.folder(); }
  /// Says in one line if that is not the requested folder; else empty.
  std::string folderNote() const { return staged_.note(); }

  /// Sets the memory (bytes) of the program at which a run ends, so that its results can still be written; by
  /// default a quarter of `memoryLimit`, since the bytes of a session may take three times as much while they
  /// grow. MRPT's filter has a limit of its own (StockMapBuilder).
  void limitMemory(double bytes) { mostBytes_ = bytes; }
  /// Limits the bytes of a session before compression: an eighth of the memory by default.
  void limitSession(double bytes) { sessionBytes_ = bytes; }
  /// Sets the memory (bytes) that the refinement may use for scans; by default a quarter of `memoryLimit`.
  /// Where it would need more, it is left out, with a note.
  void limitRefinement(double bytes) { refinementBytes_ = bytes; }
  /// Lets `finish` write no results, but throw, if the map is worse than one of this verdict (WorseMap), or
  /// if a result is missing or the log has changed (std::runtime_error).
  void expectVerdict(const Verdict& worst) { worstVerdict_ = worst; }
  /// Writes the results. If an update has failed, there is no session; a note says so.
  /// @param file     the processed log, read again for map.simplemap.gz, the verdict and the refinement
  /// @param log      its summary; if it is shorter than the processed readings (a recording on a full disk),
  ///                 map.simplemap.gz ends with it and nothing is refined; without scans, `file` is not read.
  ///                 If `file` cannot be read again, nothing is refined and there is no map.simplemap.gz
  /// @param more     further keys of metrics.json
  /// @return one line: scans, updates, time, real-time factor, place of the results
  /// @throws InputError if a result cannot be written, after which it can be called again;
  ///         WorseMap and std::runtime_error after `expectVerdict`
  std::string finish(const std::string& file, const readings::RawlogSummary& log,
                     const nlohmann::ordered_json& more);
  /// Returns why results of the finished run are missing, which notes name; empty if none are.
  const std::string& whyMissing() const { return whyMissing_; }
  /// Returns whether the log was written to or replaced since it was summarised, so that results may be of
  /// different readings.
  bool logHasChanged() const { return logHasChanged_; }
  /// The verdict on the map of the finished run.
  const Verdict& verdict() const { return verdict_; }

 private:
  struct Result {
    files::Trajectory trajectory;
    std::vector<mrpt::math::TPose2D> path;
    std::optional<mrpt::maps::COccupancyGridMap2D> grid;  ///< none if there is no memory for it
    std::vector<DatabaseLine> lines;
    ScanMap map;             ///< with our filters: the same grid and lines
    bool isRelaxed = false;  ///< refined, its errors distributed over its loops
  };
  static const mrpt::maps::COccupancyGridMap2D& gridOf(const Result& result);
  template <class State>
  void visit(State& state);
  void replaceStuckOdometry(readings::Reading& reading);
  bool filter(const readings::Reading& reading);
  bool isMemoryFull();
  void checkMemory();
  std::string memoryNote() const;
  void searchPlace(const readings::Reading& reading);
  /// Whether the scans so far contradict the earlier map, with the robot at `pose` in it.
  bool isContradictedAt(const mrpt::math::TPose2D& pose);
  void searchPlan(const readings::Reading& reading);
  /// @param pose  current pose of the robot in the map
  void joinMap(const ScanMap& map, const mrpt::math::TPose2D& pose);
  Verdict verdictOfLocalization() const;
  nlohmann::ordered_json metrics(const Result& result, const readings::RawlogSummary& log) const;
  void writeCovarianceFile(const Result& result, const std::vector<PoseCovariance>& covariances);
  ScanMap currentMap() const;  ///< of a method with lines
  /// @return whether it was written
  template <class Write>
  bool writeOrNote(const std::string& result, const Write& write);
  void writeMap(const Result& result, const std::string& file, const readings::RawlogSummary& log);
  void writeState(StateWriter& out);
  /// Returns the bytes of a session file; empty, with a note, if there can be none.
  std::string sessionWith(const ScanMap& map, const std::vector<mrpt::math::TPose2D>& poses);
  void saveSessionTo(const std::string& path, const ScanMap& map,
                     const std::vector<mrpt::math::TPose2D>& poses);
  void saveToDatedFolder();
  void saveIfDue();
  /// Writes the row of steps.csv and updates the counters.
  void record(double timestamp, Clock::time_point stepStart);
  /// Closes the remaining loops, matches the scans of the log to the map and rebuilds it.
  /// @return why not, if the scans need too much memory; else empty
  std::string refineResult(Result& result, LogAgain& log);
  std::string refineOrSayWhyNot(Result& result, const std::string& file, const readings::RawlogSummary& log);

  Configuration& configuration_;
  Clock::time_point start_;
  files::StagedFolder staged_;
  const files::OutputFolder& folder_;  ///< of staged_
  std::unique_ptr<Filter> filter_;
  HybridFilter* hybrid_ = nullptr;               ///< filter_, if it is ours
  Localizer* localizer_ = nullptr;               ///< filter_, if it localises
  std::optional<ScanMap> earlierMap_;            ///< to continue, until the place in it is found
  std::unique_ptr<Localizer> search_;            ///< for this place
  std::optional<OccupancyGrid> earlierWalls_;    ///< of this map, to compare scans with
  size_t nextPlace_ = 0;                         ///< scan from which a place may be accepted
  std::unique_ptr<PlanSearch> planSearch_;       ///< for the place in a floor plan
  bool wasPlaceUnknown_ = false;                 ///< in the session that was read
  std::optional<ScanOdometry> scanOdometry_;     ///< replaces odometry
  std::optional<StuckOdometry> stuckOdometry_;   ///< replaces it where it stands still
  std::ostringstream steps_;                     ///< in memory: a disk that is full for a while costs no row
  std::optional<std::ostringstream> particles_;  ///< likewise
  TrajectoryRecorder recorder_;
  enum class Use { skipped, carried, update };
  std::vector<Use> uses_;                            ///< per reading of the log
  std::vector<double> updateTimes_;                  ///< s
  std::vector<PoseCovariance> particleCovariances_;  ///< of each update
  std::vector<LoopClosure> refinementLoops_;         ///< not in a session: a resumed run refines again
  std::vector<std::string> notes_;
  std::atomic<bool> isSaveRequested_{false};
  std::function<void()> beforeSession_ = [] {};
  Clock::time_point lastCheckpoint_ = Clock::now();
  uint32_t fingerprint_ = 0;  ///< of the processed readings
  bool isConsistent_ = true;  ///< no reading has failed halfway
  std::string whyMissing_;
  bool logHasChanged_ = false;
  double secondsBefore_ = 0;  ///< wall time of the resumed run
  size_t scans_ = 0, resamplings_ = 0, slips_ = 0;
  size_t stuckScans_ = 0;  ///< with stuck odometry
  size_t loops_ = 0;       ///< closed while filtering
  size_t particlesMin_ = 0, particlesMax_ = 0;
  size_t located_ = 0;                     ///< localisation: updates with a known place
  double firstSlip_ = 0, firstStuck_ = 0;  ///< s
  double cell_ = 0;                        ///< m, of the filter
  double savedCell_ = 0;                   ///< m, of the map files
  double mostBytes_, refinementBytes_, sessionBytes_;
  Verdict verdict_;
  std::optional<Verdict> worstVerdict_;
  std::string checkpointName_;
  std::future<void> checkpoint_;  ///< compressed and written while the filter goes on
};

}  // namespace hybrid_slam::run
