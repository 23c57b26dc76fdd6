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
#include "run/MapRefinement.h"
#include "run/PathCovariance.h"
#include "run/PlaceSearch.h"
#include "run/ReadingUse.h"
#include "run/RunCounts.h"
#include "run/SessionFile.h"
#include "run/TrajectoryRecorder.h"
#include "run/Verdict.h"
#include "slam/filter/HybridFilter.h"
#include "slam/filter/ScanOdometry.h"
#include "slam/filter/StuckOdometry.h"
#include "slam/localization/Localizer.h"

namespace hybrid_slam::run {

/// Whether a run that began with an earlier map or a floor plan knows its place there. Saved in sessions.
enum class PlaceInMap : uint8_t {
  known,  ///< or there was neither
  searched,
  notFound,  ///< in a floor plan; the search is over
};

/// The map of a run is worse than that of another run over the log.
struct WorseMap : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A run whose results are written.
struct FinishedRun {
  std::string summary;  ///< one line: scans, updates, time, real-time factor, place of the results
  Verdict verdict;
  std::string whyMissing;  ///< for lack of memory or of the log; notes name the results; else empty
  std::string incomplete;  ///< one line: results are missing, or the log has changed meanwhile; else empty
  std::string mapNote;     ///< one line if the map files have coarser cells than the filter's; else empty
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
  void skip(size_t readings) { uses_.resize(uses_.size() + readings, ReadingUse::skipped); }

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
  bool hasEarlierMap() const { return place_ == PlaceInMap::notFound || (hybrid_ && hybrid_->base()); }
  /// Says in one line that the place in the earlier map or floor plan has not been found; else empty.
  std::string placeNote() const;

  size_t scans() const { return scans_; }           ///< processed
  size_t readings() const { return uses_.size(); }  ///< of the log, processed or skipped
  /// One line each on rejected and on stuck odometry, if there was any.
  std::vector<std::string> warnings() const { return counts_.warnings(); }
  /// Returns the events since the last call, one line each: loops closed (where, by how much, on what
  /// evidence), start found in a map, maps saved.
  std::vector<std::string> takeNotes() { return std::exchange(notes_, {}); }
  /// Returns the filter; during the search for the start in an earlier map, that search.
  const FilterView& view() const { return search_ && search_->view() ? *search_->view() : *filter_; }
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
  /// if the results are incomplete (std::runtime_error).
  void expectVerdict(const Verdict& worst) { worstVerdict_ = worst; }
  /// Writes the results. If an update has failed, there is no session; a note says so.
  /// @param file     the processed log, read again for map.simplemap.gz, the verdict and the refinement
  /// @param log      its summary; if it is shorter than the processed readings (a recording on a full disk),
  ///                 map.simplemap.gz ends with it and nothing is refined; without scans, `file` is not read.
  ///                 If `file` cannot be read again, nothing is refined and there is no map.simplemap.gz
  /// @param more     further keys of metrics.json
  /// @throws InputError if a result cannot be written, after which it can be called again;
  ///         WorseMap and std::runtime_error after `expectVerdict`
  FinishedRun finish(const std::string& file, const readings::RawlogSummary& log,
                     const nlohmann::ordered_json& more);

 private:
  template <class State>
  void visit(State& state);
  /// Returns the turn (rad) since the reading before, where the odometry measures that alone.
  std::optional<double> measuredTurn(const readings::Reading& reading) const;
  void noteRepeatedScan(const readings::Reading& reading);
  void replaceStuckOdometry(readings::Reading& reading);
  bool filter(const readings::Reading& reading);
  bool isMemoryFull();
  void checkMemory();
  std::string memoryNote() const;
  void searchPlace(const readings::Reading& reading);
  Verdict verdictOfLocalization() const;
  nlohmann::ordered_json metrics(const FinishedRun& finished, const FinishedMap& best,
                                 const readings::RawlogSummary& log) const;
  void writeCovarianceFile(const FinishedMap& best, const std::vector<PoseCovariance>& covariances);
  ScanMap currentMap() const;  ///< of a method with lines
  FinishedMap finishedMap() const;
  /// @param whyMissing  set to the reason if there is no `result`
  /// @return whether it was written
  template <class Write>
  bool writeOrNote(const std::string& result, std::string& whyMissing, const Write& write);
  /// Writes the files of the map, and sets the verdict, mapNote and whyMissing of `finished`. The log is read
  /// again for map.simplemap.gz, the verdict and the covariances.
  void writeMap(FinishedRun& finished, const FinishedMap& best, const std::string& file,
                const readings::RawlogSummary& log);
  void writeState(StateWriter& out);
  /// Returns the bytes of a session file; empty, with a note, if there can be none.
  std::string sessionWith(const ScanMap& map, const std::vector<mrpt::math::TPose2D>& poses);
  void saveSessionTo(const std::string& path, const ScanMap& map,
                     const std::vector<mrpt::math::TPose2D>& poses);
  void saveToDatedFolder();
  void saveIfDue();
  /// Writes the row of steps.csv and updates the counters.
  void record(double timestamp, Clock::time_point stepStart);

  Configuration& configuration_;
  Clock::time_point start_;
  files::StagedFolder staged_;
  const files::OutputFolder& folder_;  ///< of staged_
  std::unique_ptr<Filter> filter_;
  HybridFilter* hybrid_ = nullptr;     ///< filter_, if it is ours
  Localizer* localizer_ = nullptr;     ///< filter_, if it localises
  std::optional<PlaceSearch> search_;  ///< in an earlier map or a floor plan; until it is over
  PlaceInMap place_ = PlaceInMap::known;
  std::optional<ScanOdometry> scanOdometry_;     ///< replaces odometry
  std::optional<StuckOdometry> stuckOdometry_;   ///< replaces it where it stands still
  std::ostringstream steps_;                     ///< in memory: a disk that is full for a while costs no row
  std::optional<std::ostringstream> particles_;  ///< likewise
  TrajectoryRecorder recorder_;
  std::vector<ReadingUse> uses_;                     ///< per reading of the log
  std::vector<double> updateTimes_;                  ///< s
  std::vector<PoseCovariance> particleCovariances_;  ///< of each update
  std::vector<std::string> notes_;
  std::atomic<bool> isSaveRequested_{false};
  std::function<void()> beforeSession_ = [] {};
  Clock::time_point lastCheckpoint_ = Clock::now();
  uint32_t fingerprint_ = 0;  ///< of the processed readings
  bool hasRepeatedScans_ = false;
  bool isConsistent_ = true;  ///< no reading has failed halfway
  double secondsBefore_ = 0;  ///< wall time of the resumed run
  size_t scans_ = 0;
  RunCounts counts_;
  size_t located_ = 0;  ///< localisation: updates with a known place
  double cell_ = 0;     ///< m, of the filter
  double mostBytes_, refinementBytes_, sessionBytes_;
  std::optional<Verdict> worstVerdict_;
  std::string checkpointName_;
  std::future<void> checkpoint_;  ///< compressed and written while the filter goes on
};

}  // namespace hybrid_slam::run
