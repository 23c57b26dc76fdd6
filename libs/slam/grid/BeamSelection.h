/// @file BeamSelection.h
/// @brief Which beams of a scan to weigh or to match, where not all are.
#pragma once

#include <array>
#include <vector>

#include "base/LaserScan.h"

namespace hybrid_slam {

/// Takes beams evenly from all directions of walls: normal-space sampling (Rusinkiewicz & Levoy, 3DIM 2001).
///
/// Of beams that are evenly spread over the angle, nearly all meet the walls along a corridor, and the pose
/// along it is left to the few that meet a door frame or its end.
class BeamSelection {
 public:
  explicit BeamSelection(const LaserScan& scan);

  /// Indices in the scan, growing, of so many valid beams, or of all if there are no more; 0: of all.
  std::vector<size_t> take(int beams) const;

 private:
  std::array<std::vector<size_t>, 8>
      groups_;  ///< valid beams by the wall's direction, 22.5 deg each; the smallest first
};

}  // namespace hybrid_slam
