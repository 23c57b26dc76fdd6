/// @file FinishedPath.h
/// @brief Reads the path of a finished run back, with the covariances between its poses.
#pragma once

#include <string>
#include <vector>

#include "files/Trajectory.h"
#include "readings/EndPointReader.h"
#include "run/PathCovariance.h"

namespace hybrid_slam::run {

/// The path of a run that made a map.
struct FinishedPath {
  files::Trajectory trajectory;
  std::vector<size_t> updates;  ///< for each row of the trajectory, the number of updates up to it
  PathCovariances covariances;  ///< without the spread of the particles

  /// @param pose  map frame; at a row of the trajectory, or after it
  PathPoint at(const mrpt::math::TPose2D& pose, size_t row) const;
};

/// Compares the scans with the map again, as the run did for its verdict.
/// @param folder  results of the run (doc/results.md)
/// @param log     that it was made from
/// @param report  called before the scans are read
/// @throws InputError for an unreadable file, or a log or files of another run
FinishedPath readFinishedPath(const std::string& folder, const std::string& log,
                              const readings::WarningReport& report = {});

}  // namespace hybrid_slam::run
