/// @file PreparedScan.h
/// @brief One scan, prepared once for all particles.
#pragma once

#include <vector>

#include "grid/ScanBeams.h"
#include "lines/LineSegment.h"

namespace mrpt::obs {
class CObservation2DRangeScan;
}

namespace hybrid_slam {

/// What all particles need of one scan, prepared once.
struct PreparedScan {
  const mrpt::obs::CObservation2DRangeScan* observation;
  ScanBeams beams;                 ///< every beam, for insertion
  ScanBeams weighedBeams;          ///< every beam_step-th of [grid_weight]
  ScanBeams matchedBeams;          ///< every beam_step-th of [scan_matcher]
  std::vector<LineSegment> lines;  ///< robot frame
};

}  // namespace hybrid_slam
