/// @file RunEvaluation.h
/// @brief A finished run against what is known of the truth.
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
#include "study/simulation/FloorPlan.h"

namespace hybrid_slam::comparison {

/// What a run must keep below to have closed the loop, the paper's Fig. 4 in figures.
struct SuccessCriterion {
  double returnTrans = 0.5;    ///< m
  double returnRot = 2;        ///< deg
  double doubledShare = 0.02;  ///< of the wall that the run shows
  double relations = 0.1;      ///< m, mean translation error
  double revisits = 0.07;      ///< m, median of at least one revisit
};

/// What is known of the truth, and what the log tells without it; each part may be missing.
struct GroundTruth {
  files::Trajectory reference;                  ///< may be empty
  std::vector<evaluation::Relation> relations;  ///< may be empty
  files::Trajectory odometry;                   ///< that carries poses to the relations' times; may be empty
  std::optional<simulation::FloorPlan> plan;    ///< in the reference's frame
  std::optional<evaluation::RevisitOptions> revisits;
  std::vector<readings::EndPoints> scans;  ///< of the log; for the revisits
  std::optional<WallSightings> sightings;  ///< of the same scans; for the share of doubled wall
  SuccessCriterion criterion;

  /// s; between a pose and its reference pose
  static constexpr double kReferenceTolerance = 0.02;
  /// s; between a relation's time and a pose or odometry row
  static constexpr double kRelationTolerance = 0.006;

  /// @throws InputError if the reference does not overlap `trajectory` in time, or none of the relations can
  ///         be used with it
  void expectOverlap(const files::Trajectory& trajectory) const;
  /// Takes the log's scans, which revisits and doubled walls are measured with.
  /// @throws InputError if none of them sees a wall of the plan
  void takeScans(std::vector<readings::EndPoints> scans);
  /// What success asks for: figures that all have to be below these bounds. Empty where nothing is known.
  std::vector<std::pair<Figure, double>> bounds() const;
};

/// Fills status and figures from the run's folder. There is a success where there are bounds; a figure that a
/// run does not have is not below its own.
/// @throws InputError, std::runtime_error for result files that cannot be read
RunResult evaluateRun(const Run& run, const RunFolder& folder, const GroundTruth& truth);

}  // namespace hybrid_slam::comparison
