/// @file WallSearch.h
/// @brief The nearest wall of about the same direction.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "base/PointIndex.h"
#include "study/evaluation/PlanComparison.h"

namespace hybrid_slam::evaluation {

/// A point of a wall, with its direction (rad).
struct WallPoint {
  mrpt::math::TPoint2D at;
  double angle;
};

/// Points `step` (m) apart along the walls, which are laid end to end: each stands for the same length.
std::vector<WallPoint> pointsOn(const std::vector<PlanLine>& walls, double step);

/// The walls of one plan, to be searched.
class WallSearch {
 public:
  /// A wall near a point.
  struct Found {
    double offset;  ///< m, distance
    double angle;   ///< rad, difference of the directions, 0..pi/2
    mrpt::math::TPoint2D nearest;
  };
  /// @param options  reach and greatest angle
  WallSearch(const std::vector<PlanLine>& walls, const AgreementOptions& options);
  std::optional<Found> nearest(const WallPoint& point) const;

 private:
  const std::vector<PlanLine>& walls_;
  AgreementOptions options_;
  PointIndex index_;
};

}  // namespace hybrid_slam::evaluation
