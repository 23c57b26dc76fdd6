/// @file RunEvaluation.h
/// @brief Evaluates a finished run against the ground truth.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "files/Trajectory.h"
#include "readings/EndPoints.h"
#include "study/comparison/DoubledWalls.h"
#include "study/comparison/Figures.h"
#include "study/comparison/RunFolder.h"
#include "study/evaluation/RelationErrors.h"
#include "study/evaluation/RevisitError.h"
#include "study/simulation/BuildingPlan.h"

namespace hybrid_slam::comparison {

/// Upper bounds for a successful run, i.e. a closed loop: the paper's Fig. 4 in numbers.
struct SuccessCriterion {
  double returnTrans = 0.5;    ///< m
  double returnRot = 2;        ///< deg
  double doubledShare = 0.02;  ///< of the wall the run shows
  double relations = 0.1;      ///< m, mean translation error
  double revisits = 0.07;      ///< m, median of at least one revisit
};

/// Ground truth and reference-free criteria; each part may be missing.
struct GroundTruth {
  files::Trajectory reference;                  ///< may be empty
  std::vector<evaluation::Relation> relations;  ///< may be empty
  files::Trajectory odometry;  ///< to extrapolate poses to the relations' times; may be empty
  std::optional<simulation::BuildingPlan> plan;  ///< in the reference's frame
  std::optional<evaluation::RevisitOptions> revisits;
  std::vector<readings::EndPoints> scans;  ///< of the log, for the revisits
  std::optional<WallSightings> sightings;  ///< of the same scans, for the share of doubled wall
  SuccessCriterion criterion;

  /// Largest time difference (s) between a pose and its reference pose.
  static constexpr double kReferenceTolerance = 0.02;
  /// Largest time difference (s) between a relation and a pose or odometry row.
  static constexpr double kRelationTolerance = 0.006;

  /// @throws InputError if the reference does not overlap `trajectory` in time, or no relation is usable with
  ///         it
  void expectOverlap(const files::Trajectory& trajectory) const;
  /// Sets the log's scans, used for revisits and doubled walls.
  /// @throws InputError if no scan sees a wall of the plan
  void takeScans(std::vector<readings::EndPoints> scans);
  /// The success criterion: figures and their upper bounds. Empty without ground truth.
  std::vector<std::pair<Figure, double>> bounds() const;
};

/// Fills status and figures from the run's folder. Success is evaluated if there are bounds; a missing figure
/// fails its bound. A run with damaged or unreadable result files counts as failed.
RunResult evaluateRun(const Run& run, const RunFolder& folder, const GroundTruth& truth);

}  // namespace hybrid_slam::comparison
