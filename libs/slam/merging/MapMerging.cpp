#include "slam/merging/MapMerging.h"

#include "slam/grid/ScanMatcher.h"
#include "slam/merging/JoinedPath.h"
#include "slam/merging/MapPatches.h"
#include "slam/merging/MapTransform.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

constexpr int kPasses = 3;           // of the scans over the common map
constexpr size_t kMostWalls = 5000;  // matched

/// The placement on the cells of the maps themselves.
TPose2D precise(const TPose2D& frame, const OccupancyGrid& newer, const OccupancyGrid& older,
                const ScanMatcherOptions& options) {
  const MapPatch whole = wholeMap(newer, {middleOf(newer).x, middleOf(newer).y, 0});
  ScanBeams walls = whole.map.ends;
  const size_t every = (walls.rays.size() + kMostWalls - 1) / kMostWalls;
  walls.rays.clear();
  for (size_t i = 0; i < whole.map.ends.rays.size(); i += every) walls.rays.push_back(whole.map.ends.rays[i]);
  const TPose2D middle =
      ScanMatcher(options)
          .match(walls, frame + whole.place, older, [](const TPose2D&) { return LogDensity(); })
          .pose;
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

}  // namespace

MergedMap merged(const MapPart& older, const MapPart& newer, const MapPlacement& placement,
                 const FilterConfiguration& configuration) {
  const TPose2D frame = precise(placement.frame, newer.map.grid, older.map.grid, configuration.matcher);
  MergedMap result{frame, older.map, older.path, moved(newer.path, frame)};
  if (newer.scans.empty()) {
    addMap(result.map, newer.map, frame, configuration);
    return result;
  }
  std::vector<PosedScans> scans;
  std::optional<ScanMap> base;
  if (older.scans.empty()) {
    base = older.map;
  } else {
    joinPaths(result.older, result.newer, frame, placement.patches);
    append(scans, older.scans, result.older);
  }
  append(scans, newer.scans, result.newer);
  refine(scans, configuration, kPasses, base);
  result.map = mapOf(scans, configuration, base);
  const size_t first = scans.size() - newer.scans.size();
  for (size_t i = 0; i < scans.size(); ++i)
    (i < first ? result.older[i] : result.newer[i - first]) = scans[i].pose;
  return result;
}

}  // namespace hybrid_slam
