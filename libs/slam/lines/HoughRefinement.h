/// @file HoughRefinement.h
/// @brief Hough transform in a voting space around a fitted line (Sec. III-B, step 3).
#pragma once

#include "base/Options.h"
#include "slam/lines/LineFit.h"

namespace hybrid_slam {

/// Section [hough].
struct HoughOptions : Options {
  bool enabled = true;
  double rhoWindow = 0.1;                   ///< m
  double rhoResolution = 0.03;              ///< m
  double thetaWindow = 3 * M_PI / 180;      ///< rad
  double thetaResolution = M_PI / 180 / 4;  ///< rad

  void describe(OptionTable& table) override;
};

/// The line that most points vote for among those with |rho - rho_v| <= rhoWindow and
/// |theta - theta_v| <= thetaWindow of the fitted line, then fitted (orthogonal least squares) to the points
/// that voted for it, so that a cell's size does not bound the precision.
///
/// rho is counted about the middle of the points and not about the sensor: otherwise a turn by a far
/// segment's own angle error moves rho out of the window (see doc/paper-notes.md).
FittedLine refineByHough(PointRange points, const FittedLine& fitted, const HoughOptions& options);

}  // namespace hybrid_slam
