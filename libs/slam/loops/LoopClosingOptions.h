/// @file LoopClosingOptions.h
/// @brief Settings of loop closing by pose graph.
#pragma once

#include "base/Options.h"

namespace hybrid_slam {

/// Section [loop_closing].
struct LoopClosingOptions : Options {
  bool enabled = true;
  double minDistance = 20;  ///< m
  double stretch = 8;       ///< m
  double maxOffset = 16;    ///< m
  double minFit = 0.8;
  double maxSecond = 0.8;
  int agreeing = 3;
  void describe(OptionTable& table) override;
};

}  // namespace hybrid_slam
