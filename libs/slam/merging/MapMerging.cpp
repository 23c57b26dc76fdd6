#include "slam/merging/MapMerging.h"

#include "slam/filter/HybridFilter.h"
#include "slam/filter/Refinement.h"
#include "slam/grid/GlobalSearch.h"
#include "slam/grid/ScanMatcher.h"
#include "slam/merging/MapPatches.h"
#include "slam/merging/MapTransform.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

constexpr int kPasses = 3;                               // of the scans over the common map
constexpr size_t kMostWalls = 5000;                      // matched
constexpr double kExplained = 0.7, kContradicted = 0.1;  // shares of the beams of a scan in the older map

/// Refines the placement on the maps at their own resolution.
TPose2D precise(const TPose2D& frame, const OccupancyGrid& newer, const OccupancyGrid& older,
                const ScanMatcherOptions& options) {
  const MapPatch whole = wholeMap(newer, {newer.middle().x, newer.middle().y, 0});
  const ScanBeams walls = whole.map.ends.thinned(kMostWalls);
  const TPose2D middle = ScanMatcher(options).match(walls, frame + whole.place, older, noPrior).pose;
  return middle + (TPose2D() - whole.place);
}

std::vector<TPose2D> moved(const std::vector<TPose2D>& path, const TPose2D& frame) {
  std::vector<TPose2D> poses;
  for (const TPose2D& pose : path) poses.push_back(frame + pose);
  return poses;
}

void append(std::vector<PosedScans>& all, const std::vector<Scans>& scans, const std::vector<TPose2D>& path) {
  for (size_t i = 0; i < scans.size(); ++i) all.push_back({scans[i], path[i], true});
}

/// Filters the newer path again, in the older map from the first scan on that this map explains.
std::vector<TPose2D> filteredIn(const ScanMap& older, const std::vector<TPose2D>& path,
                                const std::vector<Scans>& scans, FilterConfiguration configuration) {
  for (double* const least : {&configuration.filter.updateDistance, &configuration.filter.updateAngle,
                              &configuration.improved.updateDistance, &configuration.improved.updateAngle})
    *least = 0;  // each of the scans is an update
  HybridFilter filter(configuration);
  filter.expectMap();
  bool isIn = false;
  for (size_t i = 0; i < scans.size(); ++i) {
    filter.process(i > 0 ? path[i] - path[i - 1] : TPose2D(), scans[i]);
    if (isIn) continue;
    const ScanBeams beams(toLaserScans(scans[i], configuration.grid.maxRange));
    const BeamShares shares = beamShares(beams, path[i], older.grid);
    isIn = shares.explained > kExplained && shares.contradicted < kContradicted;
    if (isIn) filter.joinMap(older, path[i]);
  }
  return isIn ? filter.bestPath() : path;
}

}  // namespace

MergedMap merged(const MapPart& older, const MapPart& newer, const MapPlacement& placement,
                 const FilterConfiguration& configuration) {
  const TPose2D frame = precise(placement.frame, newer.map.grid, older.map.grid, configuration.matcher);
  MergedMap result{frame, older.map, older.path, moved(newer.path, frame)};
  if (newer.scans.empty()) {
    addMap(result.map, newer.map, frame, configuration.grid, configuration.association,
           configuration.database);
    return result;
  }
  std::vector<PosedScans> scans;
  std::optional<ScanMap> base;
  if (older.scans.empty()) {
    base = older.map;
  } else {
    append(scans, older.scans, older.path);
  }
  result.newer = filteredIn(older.map, result.newer, newer.scans, configuration);
  append(scans, newer.scans, result.newer);
  refine(scans, kPasses, configuration, base);
  result.map = MapMaker(configuration)(scans, base);
  const size_t first = scans.size() - newer.scans.size();
  for (size_t i = 0; i < scans.size(); ++i)
    (i < first ? result.older[i] : result.newer[i - first]) = scans[i].pose;
  return result;
}

}  // namespace hybrid_slam
