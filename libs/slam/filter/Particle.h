/// @file Particle.h
/// @brief One hypothesis of the filter: Table 1 of the paper.
#pragma once

#include "slam/filter/Path.h"
#include "slam/grid/CowPtr.h"
#include "slam/grid/OccupancyGrid.h"
#include "slam/lines/LineDatabase.h"
#include "slam/lines/LineWeight.h"
#include "slam/motion/MotionBelief.h"

namespace hybrid_slam {

/// {path, grid, line database}, which copies share; what it has learnt of the odometry, and what its last
/// weighing gave.
struct Particle {
  Path path;
  OccupancyGrid grid;
  CowPtr<LineDatabase> lines{LineDatabase()};
  MotionBelief motion;

  double logWeight = 0;   ///< after the last weighing, before any resampling; best particle = its argmax
  double gridWeight = 1;  ///< w_grid before tempering, in [0, 1]
  LineWeight lineWeight;  ///< w_line
  bool isMatched = true;  ///< improved proposal: by a scan match, not by odometry alone
};

}  // namespace hybrid_slam
