/// @file BeamSelection.h
/// @brief Which beams of a scan to weigh or to match, where not all are.
#pragma once

#include <array>
#include <vector>

#include "base/LaserScan.h"

namespace hybrid_slam {

/// Takes the beams of all lasers evenly from all directions of walls: normal-space sampling (Rusinkiewicz &
/// Levoy, 3DIM 2001).
///
/// Of beams that are evenly spread over the angle, nearly all meet the walls along a corridor, and the pose
/// along it is left to the few that meet a door frame or its end.
class BeamSelection {
 public:
  explicit BeamSelection(const LaserScans& scans);

  /// Ascending indices of at most `beams` valid beams (0: of all), counted through the scans.
  std::vector<size_t> take(int beams) const;

 private:
  std::array<std::vector<size_t>, 8> groups_;  ///< valid beams by the wall's direction in the first laser's
                                               ///< frame, 22.5 deg each; the smallest first
};

}  // namespace hybrid_slam
