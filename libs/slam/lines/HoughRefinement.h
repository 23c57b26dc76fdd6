/// @file HoughRefinement.h
/// @brief Hough transform in a voting space around a fitted line (Sec. III-B, step 3).
#pragma once

#include <mrpt/core/bits_math.h>

#include "base/Options.h"
#include "slam/lines/LineFit.h"

namespace hybrid_slam {

/// Section [hough].
struct HoughOptions : Options {
  bool enabled = true;
  double rhoWindow = 0.1;                        ///< m
  double rhoResolution = 0.03;                   ///< m
  double thetaWindow = mrpt::DEG2RAD(3.0);       ///< rad
  double thetaResolution = mrpt::DEG2RAD(0.25);  ///< rad

  void describe(OptionTable& table) override;
};

/// Returns the line with the most votes among those with |rho - rho_v| <= rhoWindow and |theta - theta_v| <=
/// thetaWindow of the fitted line. It is then fitted to its voters (orthogonal least squares), so the cell
/// size does not limit the precision.
///
/// rho is measured from the centre of the points, not from the sensor: for a distant segment a small angle
/// error would move rho out of the window (doc/paper-notes.md).
FittedLine refineByHough(PointRange points, const FittedLine& fitted, const HoughOptions& options);

}  // namespace hybrid_slam
