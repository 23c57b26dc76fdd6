/// @file BeamSelection.h
/// @brief Selects the beams of a scan to weigh or match.
#pragma once

#include <array>
#include <vector>

#include "base/LaserScan.h"

namespace hybrid_slam {

/// Takes the beams of all lasers evenly from all directions of walls: normal-space sampling (Rusinkiewicz &
/// Levoy, 3DIM 2001).
///
/// In a corridor, nearly all of evenly spaced beams hit the side walls, and the position along it depends on
/// the few that hit a door frame or the end.
class BeamSelection {
 public:
  explicit BeamSelection(const LaserScans& scans);

  /// Returns ascending indices of at most `beams` valid beams (0: all), counted through the scans.
  std::vector<size_t> take(int beams) const;

 private:
  std::array<std::vector<size_t>, 8> groups_;  ///< valid beams by the wall's direction in the first laser's
                                               ///< frame, 22.5 deg each; the smallest first
};

}  // namespace hybrid_slam
