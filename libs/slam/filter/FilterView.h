/// @file FilterView.h
/// @brief What a program shows and saves of a running filter, whichever filter it is.
#pragma once

#include <mrpt/core/Clock.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/math/TPose2D.h>
#include <mrpt/system/CTimeLogger.h>

#include <optional>
#include <vector>

#include "slam/lines/LineDatabase.h"

namespace hybrid_slam {

struct WeightedPose {
  mrpt::math::TPose2D pose;
  double logWeight;
};

/// What one update of the filter did: a row of steps.csv. Spreads are weighted standard deviations over the
/// particles before resampling (m, rad).
struct FilterStep {
  size_t particles = 0;
  double ess = 1;                 ///< effective sample size before resampling, as a share in [0, 1]
  std::optional<bool> resampled;  ///< nothing where the filter does not tell
  double stdX = 0, stdY = 0, stdPhi = 0;
  double stdAlong = 0, stdAcross = 0;   ///< along and across the best particle's heading
  std::optional<double> gridWeight;     ///< w_grid of the best particle before tempering
  std::optional<double> lineWeight;     ///< w_line of the best particle
  int linesSeen = 0, linesMatched = 0;  ///< of the best particle
  std::optional<double> matched;    ///< share of the particles whose scan match was used; improved proposal
  std::optional<bool> slipped;      ///< the odometry was off, and the motion found by a search; likewise
  std::vector<WeightedPose> poses;  ///< those that the spreads are of

  /// @name Of our own filter, from its second update on
  /// @{
  mrpt::math::TPose2D odometry;              ///< increment since the update before
  std::vector<mrpt::math::TPose2D> motions;  ///< of each of `poses`, since the update before
  /// ln p(scan | scans before), up to a constant of the step: the weighted mean of what the particles'
  /// weights grew by. MRPT's auxiliary filters weigh otherwise.
  double logLikelihood = 0;
  /// @}
};

/// Notes a weighted set of poses and its spreads, seen along `heading`.
void setSpread(FilterStep& step, const std::vector<WeightedPose>& poses, double heading);

/// Read access common to our filter and to MRPT's own.
class FilterView {
 public:
  virtual ~FilterView() = default;
  /// Updates so far; grows by one when a scan made the filter run.
  virtual size_t updates() const = 0;
  virtual const FilterStep& lastStep() const = 0;
  /// The best particle's pose at each update (map frame).
  virtual std::vector<mrpt::math::TPose2D> bestPath() const = 0;
  virtual mrpt::maps::COccupancyGridMap2D bestGrid() const = 0;
  /// The best particle's line database; empty for a filter without lines.
  virtual std::vector<DatabaseLine> bestLines() const = 0;
  virtual std::vector<WeightedPose> particlePoses() const = 0;

  /// Where the stages of an update note their times (s); off unless enabled, and then next to free.
  mrpt::system::CTimeLogger& profiler() { return profiler_; }

 private:
  mrpt::system::CTimeLogger profiler_{false, "stages"};
};

}  // namespace hybrid_slam
