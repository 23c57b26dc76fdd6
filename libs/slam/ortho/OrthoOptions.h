/// @file OrthoOptions.h
/// @brief Settings of the orthogonal line SLAM.
#pragma once

#include <mrpt/core/bits_math.h>

#include "base/Options.h"

namespace hybrid_slam {

/// Section [ortho].
struct OrthoOptions : Options {
  double maxAngle = mrpt::DEG2RAD(30.0);   ///< rad
  double sigmaAngle = mrpt::DEG2RAD(0.5);  ///< rad
  double sigmaOffset = 0.05;               ///< m
  double gate = 3;                         ///< standard deviations
  double maxGap = 1;                       ///< m
  double minLength = 1;                    ///< m

  void describe(OptionTable& table) override;
};

}  // namespace hybrid_slam
