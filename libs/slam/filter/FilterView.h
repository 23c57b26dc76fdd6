/// @file FilterView.h
/// @brief Read access to a running filter, ours or MRPT's, for display and results.
#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/math/TPose2D.h>
#include <mrpt/system/CTimeLogger.h>

#include <optional>
#include <string>
#include <vector>

#include "slam/grid/OccupancyGrid.h"
#include "slam/lines/DirectionFrames.h"
#include "slam/lines/LineDatabase.h"
#include "slam/loops/LoopClosure.h"

namespace hybrid_slam {

/// A particle, for display.
struct WeightedPose {
  mrpt::math::TPose2D pose;
  double logWeight;

  template <class State>
  void visit(State& state) {
    state(pose, logWeight);
  }
};

/// Statistics of one filter update: a row of steps.csv. Spreads are weighted standard deviations of the
/// particles before resampling (m, rad).
struct FilterStep {
  size_t particles = 0;
  double ess = 1;                 ///< effective sample size before resampling, as a fraction in [0, 1]
  std::optional<bool> resampled;  ///< empty if the filter does not report it
  double stdX = 0, stdY = 0, stdPhi = 0;
  double stdAlong = 0, stdAcross = 0;   ///< along and across the best particle's heading
  std::optional<double> gridWeight;     ///< of the best particle: Particle.h
  std::optional<double> lineWeight;     ///< w_line of the best particle
  int linesSeen = 0, linesMatched = 0;  ///< of the best particle
  std::optional<double> matched;       ///< fraction of particles whose scan match was used; improved proposal
  std::optional<bool> slipped;         ///< odometry rejected, motion found by a search; improved proposal
  std::optional<double> degeneracy;    ///< of the scan at the best particle's pose: ScanMatcher.h
  std::vector<DirectionFrame> frames;  ///< of the best particle's database
  std::vector<WeightedPose> poses;     ///< the particles, as for the spreads
  std::optional<LoopClosure> loop;     ///< closed in this update by the pose graph

  /// @name Only for our own filter, from its second update on
  /// @{
  mrpt::math::TPose2D odometry;              ///< increment since the previous update
  std::vector<mrpt::math::TPose2D> motions;  ///< of each of `poses`, since the previous update
  /// ln p(scan | previous scans), tempered as the weights are, up to a constant of the step: log of the
  /// weighted mean of the particles' incremental weights. Not valid for MRPT's auxiliary filters, which
  /// weight differently.
  double logLikelihood = 0;
  /// @}

  /// Omits what the next step replaces: `loop`, `odometry`, `motions` and `logLikelihood`.
  template <class State>
  void visit(State& state) {
    state(particles, ess, resampled, stdX, stdY, stdPhi, stdAlong, stdAcross, gridWeight, lineWeight,
          linesSeen, linesMatched, matched, slipped, degeneracy, frames, poses);
  }
};

/// Stores the weighted poses and their spreads, with axes along and across `heading`.
void setSpread(FilterStep& step, const std::vector<WeightedPose>& poses, double heading);

/// Knowledge of the robot's place, for a filter in a fixed map.
struct Place {
  bool isKnown = false;   ///< false: several places are possible, or none fits
  bool wasKnown = false;  ///< earlier: the robot was carried away, or the surroundings have changed
  size_t hypotheses = 0;  ///< places considered while it is unknown
};

/// Returns a short text for the user, such as "start unknown: 12 hypotheses".
std::string describe(const Place& place);

/// Read access common to our filter and MRPT's.
class FilterView {
 public:
  virtual ~FilterView() = default;
  /// Number of filter updates so far.
  virtual size_t updates() const = 0;
  virtual const FilterStep& lastStep() const = 0;
  /// The best particle's pose at each update (map frame).
  virtual std::vector<mrpt::math::TPose2D> bestPath() const = 0;
  virtual mrpt::maps::COccupancyGridMap2D bestGrid() const = 0;
  /// The best particle's line database; empty for a filter without lines.
  virtual std::vector<DatabaseLine> bestLines() const = 0;
  virtual std::vector<WeightedPose> particlePoses() const = 0;
  /// Returns what a filter in a fixed map knows of the robot's place; empty for a filter that maps.
  virtual std::optional<Place> place() const { return std::nullopt; }
  /// The map of an earlier run that the filter continues, once its place there is known; else null.
  virtual const OccupancyGrid* earlierMap() const { return nullptr; }

  /// Times (s) of the stages of an update; off by default, negligible cost.
  mrpt::system::CTimeLogger& profiler() { return profiler_; }

 private:
  mrpt::system::CTimeLogger profiler_{false, "stages"};
};

}  // namespace hybrid_slam
