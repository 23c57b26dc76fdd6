/// @file PlanComparison.h
/// @brief Compares a floor plan with the true one.
#pragma once

#include <mrpt/core/bits_math.h>
#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <optional>
#include <vector>

#include "files/Trajectory.h"
#include "readings/EndPoints.h"
#include "slam/plan/PlanLine.h"

namespace hybrid_slam::evaluation {

/// Two walls agree at a point of one if the other passes within `distance` (m) and their directions differ by
/// at most `angle` (rad).
struct AgreementOptions {
  double distance = 0.1;
  double angle = mrpt::DEG2RAD(15.0);
};

/// Lengths in m, percentages of lengths.
struct PlanErrors {
  double truth = 0, plan = 0;
  double seen = 0;                    ///< of the truth; with end points only
  double found = 0;                   ///< %, of the truth, that agrees with the plan
  std::optional<double> foundOfSeen;  ///< %, with end points only
  double wrong = 0;                   ///< %, of the plan, that agrees with no true wall
  double medianDistance = 0;          ///< m, of the rest from the true walls
  double medianAngle = 0;             ///< rad, of the rest to the true walls
};

/// Returns the end points of the scans that have a true pose within 0.001 s, in the frame of the reference.
std::vector<mrpt::math::TPoint2D> placedEndPoints(const std::vector<readings::EndPoints>& scans,
                                                  const files::Trajectory& reference);

/// Returns the pose of the plan's frame in the truth's at which most of the plan agrees. Tries the four
/// headings that align the walls' directions, each with the translation that aligns most of their offsets,
/// and returns the best after least squares on the nearest walls.
mrpt::math::TPose2D alignmentOf(const std::vector<PlanLine>& plan, const std::vector<PlanLine>& truth);

/// @param ends  end points of the laser: a piece of a true wall was seen if three of them lie within 0.05 m
PlanErrors comparePlans(const std::vector<PlanLine>& plan, const std::vector<PlanLine>& truth,
                        const std::vector<mrpt::math::TPoint2D>& ends, const AgreementOptions& options = {});

/// Moves walls rigidly.
std::vector<PlanLine> moved(std::vector<PlanLine> walls, const mrpt::math::TPose2D& by);

}  // namespace hybrid_slam::evaluation
