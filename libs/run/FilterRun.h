/// @file FilterRun.h
/// @brief A filter and the results that it leaves, whoever feeds it: a log or a robot.
#pragma once

#include <chrono>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "files/OutputFolder.h"
#include "readings/RawlogSource.h"
#include "run/Configuration.h"
#include "run/TrajectoryRecorder.h"
#include "slam/filter/Filter.h"

namespace hybrid_slam::run {

/// Writes steps.csv (and particles.csv) while it runs, and the other files of doc/results.md at its end.
/// Without `finish` no result is left.
class FilterRun {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param configuration  outlives the run
  /// @param start          since when `wall_s` counts
  /// @throws InputError for settings that the filter does not take, or an output folder that cannot be
  /// written
  explicit FilterRun(Configuration& configuration, Clock::time_point start = Clock::now());
  ~FilterRun();

  /// One reading through the filter.
  /// @return whether the filter was updated with it, not only the odometry gathered
  bool process(const readings::Reading& reading);
  /// So many readings of the log are left out here; the motion of the next one holds theirs.
  void skip(size_t readings) { uses_.resize(uses_.size() + readings, Use::skipped); }

  size_t scans() const { return scans_; }  ///< processed
  /// One line on the updates in which the odometry was far off; empty if there were none.
  std::string slipNote() const;
  const FilterView& view() const { return *filter_; }
  /// The times of the stages; enable it before the first scan. Changes no result.
  mrpt::system::CTimeLogger& profiler() { return filter_->profiler(); }
  const files::OutputFolder& folder() const { return folder_; }

  /// Writes the results.
  /// @param file     the log that was processed, read again for map.simplemap.gz and the refinement
  /// @param log      what it holds; where that is less than was processed (a recording on a full disk),
  ///                 map.simplemap.gz and the refinement end there
  /// @param version  of the program
  /// @param more     further keys of metrics.json
  /// @return one line: scans, updates, time, real-time factor
  /// @throws InputError if a result cannot be written
  std::string finish(const std::string& file, const readings::RawlogSummary& log, const std::string& version,
                     const nlohmann::ordered_json& more);

 private:
  struct Result {
    files::Trajectory trajectory;
    std::vector<mrpt::math::TPose2D> path;
    mrpt::maps::COccupancyGridMap2D grid;
    std::vector<DatabaseLine> lines;
  };
  /// Matches the scans of the log against the map and builds it anew.
  void refineResult(Result& result, readings::RawlogSource& source) const;

  Configuration& configuration_;
  Clock::time_point start_;
  files::OutputFolder folder_;
  std::unique_ptr<Filter> filter_;
  files::GrowingFile steps_;
  std::optional<files::GrowingFile> particles_;
  TrajectoryRecorder recorder_;
  enum class Use { skipped, carried, update };
  std::vector<Use> uses_;  ///< of each reading of the log
  size_t scans_ = 0, resamplings_ = 0, slips_ = 0;
  double firstSlip_ = 0;  ///< s
};

}  // namespace hybrid_slam::run
