#include "slam/merging/MapPlacement.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/Degree.h"
#include "base/PoseDistance.h"
#include "slam/filter/Threads.h"
#include "slam/grid/GlobalSearch.h"
#include "slam/merging/MapPatches.h"
#include "slam/merging/MapTransform.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

constexpr double kCell = 0.1;                                      // m, at least
constexpr size_t kPlaces = 24;                                     // of a patch
constexpr double kMinFit = 0.75, kMinOverlap = 0.5;                // of a patch
constexpr double kElsewhere = 0.6, kElsewhereAngle = 5 * kDegree;  // m, rad: another place
constexpr double kAgree = 0.4, kAgreeAngle = 3 * kDegree;          // m, rad: a patch agrees with a place
constexpr double kMinPatchFit = 0.97;  // median of the patches that agree with a place
constexpr size_t kLeastPatches = 3;
constexpr double kLeastCompared = 20, kLeastFit = 0.75, kMostSecond = 0.8;

TPose2D inverse(const TPose2D& pose) { return TPose2D() - pose; }

double medianFit(std::vector<PatchMatch> patches) {
  if (patches.empty()) return 0;
  const auto middle = patches.begin() + static_cast<ptrdiff_t>(patches.size() / 2);
  std::nth_element(patches.begin(), middle, patches.end(),
                   [](const PatchMatch& a, const PatchMatch& b) { return a.fit < b.fit; });
  return middle->fit;
}

/// A place of the whole newer map.
struct Place {
  TPose2D middle;  ///< of the newer map, in the older
  Agreement agreement;
};

class Placer {
 public:
  Placer(const OccupancyGrid& newer, const OccupancyGrid& older, int threads)
      : older_(wholeMap(older, {})),
        newer_(wholeMap(newer, {newer.middle().x, newer.middle().y, 0})),
        patches_(patchesOf(newer)),
        search_(older, older.middle()),
        arena_(arenaThreads(threads)) {}

  /// @param headings  of the newer map's frame in the older's; empty: all
  MapPlacement search(const std::vector<double>& headings) {
    std::vector<std::vector<PatchMatch>> found(patches_.size());
    parallelFor(arena_, 0, patches_.size(), [&](size_t i) { found[i] = matches(patches_[i], headings); });
    std::vector<PatchMatch> all;
    for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
    return best(all);
  }

 private:
  std::vector<PatchMatch> matches(const MapPatch& patch, const std::vector<double>& headings) const {
    std::vector<PatchMatch> all;
    for (const GlobalSearch::Place& place : search_(patch.map.ends, headings, kPlaces)) {
      const LoopMatch match = matchFrom(place.pose, patch.map, older_.map);
      const bool isKnown = std::any_of(all.begin(), all.end(), [&](const PatchMatch& other) {
        return isWithin(match.pose, other.older, kAgree, kAgreeAngle);
      });
      if (isKnown || match.agreement.fit < kMinFit || match.agreement.overlap < kMinOverlap) continue;
      all.push_back({patch.place, match.pose, match.agreement.fit});
    }
    return all;
  }

  /// Returns the places that the patches suggest, without duplicates.
  std::vector<Place> places(const std::vector<PatchMatch>& matches) {
    std::vector<Place> all;
    for (const PatchMatch& match : matches) {
      const TPose2D middle = match.older + (newer_.place - match.newer);
      const bool isKnown = std::any_of(all.begin(), all.end(), [&](const Place& other) {
        return isWithin(middle, other.middle, kAgree, kAgreeAngle);
      });
      if (!isKnown) all.push_back({middle, {}});
    }
    parallelFor(arena_, 0, all.size(), [&](size_t i) {
      const LoopMatch match = matchFrom(all[i].middle, newer_.map, older_.map);
      all[i] = {match.pose, match.agreement};
    });
    return all;
  }

  /// Returns the matches that agree with a place.
  std::vector<PatchMatch> supporting(const Place& place, const std::vector<PatchMatch>& matches) const {
    const TPose2D frame = place.middle + inverse(newer_.place);
    std::vector<PatchMatch> some;
    for (const PatchMatch& match : matches)
      if (isWithin(match.older, frame + match.newer, kAgree, kAgreeAngle)) some.push_back(match);
    return some;
  }

  MapPlacement best(const std::vector<PatchMatch>& matches) {
    std::vector<Place> all = places(matches);
    // Corridors differ only in small objects, which a patch shows and a whole map hides.
    const auto isPoor = [&](const Place& place) {
      return medianFit(supporting(place, matches)) < kMinPatchFit;
    };
    const auto rest = std::stable_partition(all.begin(), all.end(), std::not_fn(isPoor));
    if (rest != all.begin()) all.erase(rest, all.end());
    MapPlacement placement;
    const auto best = std::max_element(all.begin(), all.end(), [](const Place& a, const Place& b) {
      return a.agreement.score() < b.agreement.score();
    });
    if (best == all.end() || best->agreement.score() <= 0) return placement;
    placement.frame = best->middle + inverse(newer_.place);
    placement.agreement = best->agreement;
    placement.compared = best->agreement.overlap * static_cast<double>(newer_.map.ends.rays.size()) *
                         newer_.map.grid.resolution();
    placement.patches = supporting(*best, matches);
    placement.patchFit = medianFit(placement.patches);
    for (const Place& place : all)
      if (!isWithin(place.middle, best->middle, kElsewhere, kElsewhereAngle))
        placement.second = std::max(placement.second, place.agreement.score() / best->agreement.score());
    return placement;
  }

  MapPatch older_, newer_;
  std::vector<MapPatch> patches_;
  GlobalSearch search_;
  tbb::task_arena arena_;
};

/// Headings at which the directions of the walls agree; empty if one of the maps has none.
std::vector<double> alignedFrames(const LineDatabase& newer, const LineDatabase& older) {
  std::vector<double> headings;
  if (newer.dominatingDirection() && older.dominatingDirection())
    for (int k = 0; k < 4; ++k)
      headings.push_back(
          mrpt::math::wrapToPi(*older.dominatingDirection() - *newer.dominatingDirection() + k * M_PI / 2));
  return headings;
}

}  // namespace

bool MapPlacement::hasEvidence() const {
  return patches.size() >= kLeastPatches && patchFit >= kMinPatchFit && compared >= kLeastCompared &&
         agreement.fit >= kLeastFit;
}

bool MapPlacement::isAmbiguous() const { return second > kMostSecond; }

MapPlacement placementOf(const ScanMap& newer, const ScanMap& older, int threads) {
  const double cell = std::max({kCell, newer.grid.resolution(), older.grid.resolution()});
  Placer placer(resampled(newer.grid, {}, cell), resampled(older.grid, {}, cell), threads);
  const std::vector<double> headings = alignedFrames(newer.lines, older.lines);
  MapPlacement placement = placer.search(headings);
  if (!placement.hasEvidence() && !headings.empty()) placement = placer.search({});
  return placement;
}

}  // namespace hybrid_slam
