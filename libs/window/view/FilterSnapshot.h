/// @file FilterSnapshot.h
/// @brief Immutable snapshot of a running filter for display, taken in the filter's thread.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "readings/ReadingAssembler.h"
#include "run/Configuration.h"
#include "run/VerdictCheck.h"
#include "slam/filter/FilterView.h"
#include "slam/filter/PreparedScan.h"
#include "slam/lines/LineDatabase.h"
#include "slam/lines/LineWeight.h"
#include "window/view/MapImage.h"

namespace hybrid_slam::window {

/// One filter update in the plots, at which the place was known.
struct PlotRow {
  double time = 0;                        ///< s since the first scan
  double stdX = 0, stdY = 0, stdPhi = 0;  ///< m, m, rad
  double ess = 1;                         ///< fraction in [0, 1]
};

/// A line of the current scan in the map frame, by the best particle's pose.
struct ScanLine {
  LineSegment segment;
  bool isMatched = false;  ///< as in w_line: in direction, with the database before this scan
};

/// The 1-sigma ellipse of the particle positions.
struct UncertaintyEllipse {
  mrpt::math::TPoint2D centre{0, 0};  ///< m, map frame: the weighted mean
  double major = 0, minor = 0;        ///< m, semi-axes
  double direction = 0;               ///< rad, of the major axis
};

/// What a window shows of a filter.
struct FilterSnapshot {
  std::string method;  ///< as in `--method`
  size_t updates = 0;
  MapImage map;  ///< of the best particle, like the next three
  /// One pose per update; the last is the current one. In a fixed map, only since the place is known; empty
  /// while it is not.
  std::vector<mrpt::math::TPose2D> path;
  std::vector<DatabaseLine> lines;
  std::optional<double> dominatingDirection;  ///< rad, modulo a right angle
  std::vector<WeightedPose> particles;        ///< possible places, while the place is unknown
  std::optional<Place> place;                 ///< in a fixed map
  std::vector<ScanLine> scanLines;            ///< of the last update
  UncertaintyEllipse ellipse;
  std::vector<PlotRow> plot;
  FilterStep step;                      ///< the last update
  std::optional<run::Verdict> verdict;  ///< on the path so far; empty in a fixed map, or if not requested
};

/// Collects snapshots of one filter in its thread.
class FilterWatch {
 public:
  /// @param configuration  of the filter
  /// @param judges         keeps the scans for `withVerdict`
  explicit FilterWatch(const run::Configuration& configuration, bool judges = false);

  /// Call after each scan. @param isUpdate  whether it caused an update
  void saw(const FilterView& view, const readings::Reading& reading, bool isUpdate);
  /// Copies the grid, which takes some ms: call only when needed for display.
  /// @param withVerdict  compares the scans along the path, which may take 0.1 s
  std::shared_ptr<FilterSnapshot> snapshot(const FilterView& view, bool withVerdict = false) const;

 private:
  std::string method_;
  bool useLines_, judges_;
  LineWeightOptions lineWeight_;
  ScanPreparation prepare_;
  std::optional<double> start_;  ///< s
  size_t knownFrom_ = 0;         ///< update since which the place has been known
  std::vector<PlotRow> plot_;
  run::RunningVerdict mapSoFar_;
  Scans scans_;                                         ///< of the last update
  std::vector<DatabaseLine> linesBefore_, linesAfter_;  ///< the last update
};

/// The uncertainty ellipse of weighted poses.
UncertaintyEllipse uncertaintyOf(const std::vector<WeightedPose>& poses);

}  // namespace hybrid_slam::window
