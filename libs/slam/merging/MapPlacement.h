/// @file MapPlacement.h
/// @brief Finds a map in another one.
#pragma once

#include <vector>

#include "slam/filter/MapMaker.h"
#include "slam/loops/LoopMatch.h"

namespace hybrid_slam {

/// A patch of the newer map that matches the older one.
struct PatchMatch {
  mrpt::math::TPose2D newer;  ///< the patch in the newer map (m, rad)
  mrpt::math::TPose2D older;  ///< the same in the older map
  double fit = 0;             ///< share of the compared walls that agree
};

/// The newer map in the older one, and the evidence for it.
struct MapPlacement {
  mrpt::math::TPose2D frame;        ///< of the newer map in that of the older (m, rad)
  Agreement agreement;              ///< of the whole maps
  double compared = 0;              ///< m of wall of the newer map in known cells of the older
  double second = 0;                ///< highest score elsewhere, as a fraction of this one's
  std::vector<PatchMatch> patches;  ///< matches that agree with it
  double patchFit = 0;              ///< median `fit` of these, which drift does not affect

  /// Returns whether at least three patches match with a median fit of 95 %, and at least 20 m of wall are
  /// compared, of which 75 % agree.
  bool hasEvidence() const;
  /// Returns whether another place is nearly as good.
  bool isAmbiguous() const;
  bool isFound() const { return hasEvidence() && !isAmbiguous(); }
};

/// Searches the whole older map for patches of the newer one, at the headings that align the walls in the
/// line databases; at all headings if this finds nothing. The suggested places are judged by the whole maps,
/// on cells of at least 0.1 m; only patches that agree on the place count.
/// @param threads  0: all cores
MapPlacement placementOf(const ScanMap& newer, const ScanMap& older, int threads);

}  // namespace hybrid_slam
