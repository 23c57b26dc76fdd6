/// @file Particle.h
/// @brief One hypothesis of the filter: Table 1 of the paper. By the factorisation of eq. (1), its maps
/// follow from its path and the scans.
#pragma once

#include "slam/features/FeatureDatabase.h"
#include "slam/filter/Path.h"
#include "slam/grid/CowPtr.h"
#include "slam/grid/OccupancyGrid.h"
#include "slam/lines/LineDatabase.h"
#include "slam/lines/LineWeight.h"
#include "slam/motion/MotionBelief.h"

namespace hybrid_slam {

/// {path, grid, line database, features}, shared between copies; the odometry error estimate and the last
/// weights.
struct Particle {
  Path path;
  OccupancyGrid grid;
  CowPtr<LineDatabase> lines{LineDatabase()};
  /// Not in `visit`: ParticleSet visits them if they are on, so that the bytes of sessions without them do
  /// not change.
  CowPtr<FeatureDatabase> features{FeatureDatabase()};
  MotionBelief motion;

  double logWeight = 0;   ///< after the last weighting, before resampling; the best particle is its argmax
  double gridWeight = 1;  ///< in [0, 1]: w_grid before tempering; with the improved proposal, the match's fit
  LineWeight lineWeight;  ///< w_line
  bool isMatched = true;  ///< improved proposal: from a scan match, not odometry alone

  template <class State>
  void visit(State& state) {
    state(path, grid, lines, motion, logWeight, gridWeight, lineWeight, isMatched);
    state.check(!path.empty() && lines, "a particle is not complete");
  }
};

}  // namespace hybrid_slam
