/// @file FeatureOptions.h
/// @brief Settings of the corners and arcs.
#pragma once

#include "base/Options.h"

namespace hybrid_slam {

/// Section [features].
struct FeatureOptions : Options {
  bool enabled = false;
  bool wallEnds = true;
  double minWall = 0.1;   ///< m
  double maxRadius = 15;  ///< m
  double sigma = 0.007;   ///< m
  double floor = 0.001;
  int minCount = 3;
  int pruneInterval = 10;

  void describe(OptionTable& table) override;
};

}  // namespace hybrid_slam
