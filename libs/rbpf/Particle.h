/// @file Particle.h
/// @brief One hypothesis of the filter: Table 1 of the paper.
#pragma once

#include "grid/CowPtr.h"
#include "grid/OccupancyGrid.h"
#include "lines/LineDatabase.h"
#include "lines/LineWeight.h"
#include "rbpf/Path.h"

namespace hybrid_slam {

/// {path, grid, line database}, and what its last weighing gave. Copying shares all three.
struct Particle {
  Path path;
  OccupancyGrid grid;
  CowPtr<LineDatabase> lines{LineDatabase()};

  double logWeight = 0;   ///< after the last weighing, before any resampling; best particle = its argmax
  double gridWeight = 1;  ///< w_grid before tempering, in [0, 1]
  LineWeight lineWeight;  ///< w_line
  bool isMatched = true;  ///< improved proposal: by a scan match, not by odometry alone
};

}  // namespace hybrid_slam
