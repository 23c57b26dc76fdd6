/// @file LoopClosure.h
/// @brief A closed loop: the corrected path and the evidence.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <optional>
#include <vector>

namespace hybrid_slam {

/// A closed loop and its evidence.
struct LoopClosure {
  std::vector<mrpt::math::TPose2D> path;  ///< corrected, a pose for each update
  mrpt::math::TPose2D place;              ///< corrected pose at the later visit
  std::optional<size_t> earlier;          ///< update of the earlier visit; empty: the map of an earlier run
  size_t later = 0;                       ///< update of the later visit
  double shift = 0;                       ///< m, largest displacement of the path
  double turn = 0;                        ///< rad, largest change of a heading
  double fit = 0;                         ///< lowest share of agreeing walls among the matches
  double second = 0;                      ///< highest score of another place, as a fraction of the best
  size_t matches = 0;                     ///< that agree
};

}  // namespace hybrid_slam
