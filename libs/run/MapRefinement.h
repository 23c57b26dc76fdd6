/// @file MapRefinement.h
/// @brief The map of a finished run, and its refinement with the scans of the log.
#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>

#include <optional>
#include <string>
#include <vector>

#include "files/Trajectory.h"
#include "run/Configuration.h"
#include "run/LogAgain.h"
#include "run/ReadingUse.h"
#include "run/TrajectoryRecorder.h"
#include "slam/filter/MapMaker.h"
#include "slam/lines/LineDatabase.h"
#include "slam/loops/LoopClosure.h"

namespace hybrid_slam::run {

/// The best map of a run, at its end.
struct FinishedMap {
  files::Trajectory trajectory;                         ///< a pose for each scan
  std::vector<mrpt::math::TPose2D> path;                ///< a pose for each update
  std::optional<mrpt::maps::COccupancyGridMap2D> grid;  ///< none if there is no memory for it
  std::vector<DatabaseLine> lines;
  ScanMap map;                     ///< with our filters: the same grid and lines
  bool hasMap = false;             ///< there was memory for `map`
  std::vector<LoopClosure> loops;  ///< closed by the refinement
  bool isRelaxed = false;          ///< refined, its errors distributed over its loops

  /// @throws std::bad_alloc if there was no memory for it
  const mrpt::maps::COccupancyGridMap2D& gridOrThrow() const;
};

/// Closes the remaining loops, distributes their errors, matches every scan of the log to the map of all, and
/// rebuilds the map (slam/filter/Refinement.h).
class MapRefinement {
 public:
  /// The references must outlive it.
  /// @param uses       of each reading of the log
  /// @param base       earlier map that the run continues: then no loops are closed
  /// @param mostBytes  of the scans
  MapRefinement(const Configuration& configuration, const TrajectoryRecorder& recorder,
                const std::vector<ReadingUse>& uses, const std::optional<ScanMap>& base, double mostBytes)
      : configuration_(configuration), recorder_(recorder), uses_(uses), base_(base), mostBytes_(mostBytes) {}

  /// @return why `best` could not be refined, and stays as it is; else empty
  std::string operator()(FinishedMap& best, const std::string& file,
                         const readings::RawlogSummary& log) const;

 private:
  std::vector<PosedScans> read(LogAgain& log, const files::Trajectory& trajectory) const;
  void closeLoops(FinishedMap& best, const std::vector<Scans>& scans) const;
  FinishedMap refined(FinishedMap best, std::vector<PosedScans> scans) const;

  const Configuration& configuration_;
  const TrajectoryRecorder& recorder_;
  const std::vector<ReadingUse>& uses_;
  const std::optional<ScanMap>& base_;
  double mostBytes_;
};

}  // namespace hybrid_slam::run
