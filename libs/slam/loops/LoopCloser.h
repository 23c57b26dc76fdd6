/// @file LoopCloser.h
/// @brief Finds loops that a path does not close, and the path that closes them.
#pragma once

#include <optional>
#include <vector>

#include "slam/grid/OccupancyGrid.h"
#include "slam/lines/LineDatabase.h"
#include "slam/loops/LocalMap.h"
#include "slam/loops/LoopClosingOptions.h"
#include "slam/loops/LoopClosure.h"
#include "slam/loops/LoopMatch.h"
#include "slam/loops/PathUncertainty.h"
#include "slam/loops/PoseGraph.h"
#include "slam/loops/RevisitCheck.h"

namespace hybrid_slam {

/// The newest stretch of the path is matched, as one rigid map, to the maps of earlier stretches that may be
/// the same place by the uncertainty of the path. There are three outcomes:
///
/// - The path already fits there. The pair of poses is *held*: it becomes an edge of the pose graph with the
///   path's own relative pose, so that a later closure does not break it.
/// - The stretch fits at one other pose, and nowhere else as well. This match is a candidate.
/// - The stretch fits at several poses. A longer stretch is tried.
///
/// After `joinMap`, the stretch is matched first to the map of the earlier run, with the same outcomes.
///
/// Once several successive candidates agree on the correction, the pose graph of the motions, the held pairs,
/// the candidates and the directions of the walls is optimised. If the scans then contradict the map more
/// than before, the candidates are dropped.
///
/// Keeps about 7 kB for each metre of the path.
class LoopCloser {
 public:
  LoopCloser(const LoopClosingOptions& options, const GridOptions& grid);

  /// Forgets the path.
  void reset() { *this = LoopCloser(options_, grid_); }
  /// Adds an update: its motion by the best path, the scans after it, and their lines (robot frame; empty
  /// without lines).
  void add(const mrpt::math::TPose2D& motion, const LaserScans& scans, const std::vector<LineSegment>& lines,
           bool hasSlipped);
  /// Returns whether the path has grown enough since the last attempt.
  bool isDue() const { return toAttempt_ <= 0; }
  /// Tries to close a loop at the end of the path.
  /// @param path       a pose for each update, map frame
  /// @param direction  direction of the walls, modulo 90 deg, rad, map frame; empty: unknown
  /// @param earlier    map of an earlier run in which `joinMap` placed the path; null without one
  std::optional<LoopClosure> close(const std::vector<mrpt::math::TPose2D>& path,
                                   const std::optional<double>& direction,
                                   const OccupancyGrid* earlier = nullptr);

  /// The robot has been found in the map of an earlier run, whose frame is now that of the path.
  /// @param path  transformed, a pose for each update
  void joinMap(const std::vector<mrpt::math::TPose2D>& path);

  template <class State>
  void visit(State& state) {
    state(keyframes_, variances_, wallDirections_, loops_, candidates_, updates_, motion_, variance_,
          toAttempt_);
    const size_t count = keyframes_.size();
    bool isWhole = variances_.size() == count && wallDirections_.size() == count;
    for (size_t i = 0; i < count && isWhole; ++i)
      isWhole = keyframes_[i].update < updates_ &&
                (i == 0 || keyframes_[i - 1].update < keyframes_[i].update) && variances_[i].isOfMotion() &&
                keyframes_[i].beams.areWithin(grid_.maxRange);
    const auto isEdge = [count](size_t from, size_t to) {
      return (from < to || from == PoseEdge::kMapFrame) && to < count;
    };
    for (const PoseEdge& edge : loops_) isWhole = isWhole && isEdge(edge.from, edge.to);
    for (const Candidate& candidate : candidates_)
      isWhole = isWhole && isEdge(candidate.edge.from, candidate.edge.to);
    state.check(isWhole, "the loops do not belong to the path");
  }
  size_t updates() const { return updates_; }

 private:
  struct Candidate {
    PoseEdge edge;
    double fit;     ///< share of agreeing walls
    double second;  ///< score of another place, as a fraction of this one's

    template <class State>
    void visit(State& state) {
      state(edge, fit, second);
    }
  };
  /// The path of the keyframes.
  struct Track {
    std::vector<mrpt::math::TPose2D> poses;  ///< of the keyframes, map frame
    std::vector<double> distances;           ///< m, along the path
    std::vector<KnownPair> known;            ///< the pairs held or closed
    mrpt::math::TPose2D frame(size_t reference) const {
      return reference == PoseEdge::kMapFrame ? mrpt::math::TPose2D() : poses[reference];
    }
  };
  enum class Outcome { none, held, ambiguous, found };
  Track trackOf(const std::vector<mrpt::math::TPose2D>& path) const;
  Outcome tryEarlierMap(const Track& track, const LocalMap& stretch, const PathUncertainty& uncertainty,
                        const OccupancyGrid& map);
  Outcome tryPlace(const Track& track, const LocalMap& stretch, const LocalMap& older,
                   const Eigen::Matrix3d& covariance);
  std::vector<size_t> places(const Track& track, size_t here, const PathUncertainty& uncertainty) const;
  void remember(const Track& track, const Candidate& candidate);
  /// The keyframes that return if they are at these poses; `update` is the index of a keyframe.
  std::vector<Revisit> revisits(const std::vector<mrpt::math::TPose2D>& poses) const;
  /// The motions between keyframes.
  std::vector<PoseEdge> motionEdges(const Track& track) const;
  std::optional<LoopClosure> optimise(const std::vector<mrpt::math::TPose2D>& path, const Track& track,
                                      const std::optional<double>& direction);
  LocalMap newest(const Track& track, double length) const;
  LocalMap around(const Track& track, size_t keyframe, double reach, double length) const;

  LoopClosingOptions options_;
  GridOptions grid_;  ///< coarse
  std::vector<Keyframe> keyframes_;
  std::vector<StepVariance> variances_;                ///< of the motions between keyframes
  std::vector<std::optional<double>> wallDirections_;  ///< of each keyframe, robot frame, modulo 90 deg
  std::vector<PoseEdge> loops_;                        ///< held or closed
  std::vector<Candidate> candidates_;                  ///< successive, in agreement
  size_t updates_ = 0;
  mrpt::math::TPose2D motion_;  ///< since the last keyframe
  StepVariance variance_;       ///< of this motion
  double toAttempt_ = 0;        ///< m of path
};

}  // namespace hybrid_slam
