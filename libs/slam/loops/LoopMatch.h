/// @file LoopMatch.h
/// @brief Finds one local map in another, and measures their agreement.
#pragma once

#include <Eigen/Dense>
#include <optional>

#include "slam/grid/CorrelativeSearch.h"
#include "slam/loops/LocalMap.h"

namespace hybrid_slam {

/// Agreement of two local maps at a relative pose. A cell with a wall in one map and free space in the other
/// is a contradiction; cells unknown to one map are not compared.
struct Agreement {
  double fit = 0;      ///< share of the compared walls on which both agree
  double overlap = 0;  ///< share of the newer map's walls that are compared
  double score() const { return fit * fit * overlap; }
};

/// The best place of one local map in another.
struct LoopMatch {
  mrpt::math::TPose2D pose;  ///< of the newer map's frame in the older's
  Agreement agreement;
  double second = 0;  ///< highest score elsewhere in the window, as a fraction of this one's
};

/// Compares two local maps. @param pose  of the newer map's frame in the older's
Agreement agreementOf(const LocalMap& newer, const LocalMap& older, const mrpt::math::TPose2D& pose);

/// Information of the beams of the newer map on its pose in the older map (x, y, phi; axes of the older map;
/// 1/m^2, 1/(m rad), 1/rad^2).
Eigen::Matrix3d informationOf(const mrpt::math::TPose2D& pose, const LocalMap& newer, const LocalMap& older);

/// Matches locally, from `start`.
LoopMatch matchFrom(const mrpt::math::TPose2D& start, const LocalMap& newer, const LocalMap& older);

/// The best match in the window; empty if there is none.
std::optional<LoopMatch> searchMatch(const mrpt::math::TPose2D& centre, const SearchWindow& window,
                                     const LocalMap& newer, const LocalMap& older);

}  // namespace hybrid_slam
