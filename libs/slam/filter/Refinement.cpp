#include "slam/filter/Refinement.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include "slam/filter/Threads.h"
#include "slam/grid/BeamSelection.h"
#include "slam/grid/ScanMatcher.h"
#include "slam/loops/LoopCloser.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

OccupancyGrid gridOf(const std::vector<PosedScans>& scans, const GridOptions& options,
                     const std::optional<ScanMap>& base) {
  OccupancyGrid grid = base ? base->grid : OccupancyGrid(options.resolution);
  for (const PosedScans& posed : scans)
    if (posed.isMapped)
      grid.insert(ScanBeams(toLaserScans(posed.scans, options.maxRange)), posed.pose, options);
  return grid;
}

}  // namespace

MapMaker::MapMaker(const FilterConfiguration& configuration)
    : prepare_(configuration),
      grid_(configuration.grid),
      database_(configuration.databaseOptions()),
      association_(configuration.association),
      features_(configuration.features) {}

ScanMap MapMaker::operator()(const std::vector<PosedScans>& scans, const std::optional<ScanMap>& base) const {
  ScanMap map{gridOf(scans, grid_, base), base ? base->lines : LineDatabase(),
              base ? base->features : FeatureDatabase()};
  for (const PosedScans& posed : scans) {
    if (!posed.isMapped) continue;
    const LaserScans scan = toLaserScans(posed.scans, grid_.maxRange);
    map.lines.update(transformed(prepare_.lines(scan), posed.pose), database_, association_);
    if (!features_.enabled) continue;
    std::vector<PointFeature> features = prepare_.features(scan);
    for (PointFeature& feature : features) feature = transformed(feature, posed.pose);
    map.features.update(features, features_);
  }
  return map;
}

std::vector<LoopClosure> closeLoops(std::vector<TPose2D>& path, const std::vector<Scans>& scans,
                                    const std::optional<double>& direction,
                                    const FilterConfiguration& configuration) {
  const ScanPreparation prepare(configuration);
  LoopCloser closer(configuration.loopClosing, configuration.grid);
  std::vector<LoopClosure> closures;
  for (size_t i = 0; i < scans.size(); ++i) {
    const LaserScans seen = toLaserScans(scans[i], configuration.grid.maxRange);
    closer.add(i > 0 ? path[i] - path[i - 1] : TPose2D(), seen, prepare.lines(seen), false);
    if (!closer.isDue()) continue;
    auto closure = closer.close(path, direction);
    if (!closure) continue;
    path = closure->path;
    closures.push_back(std::move(*closure));
  }
  return closures;
}

void refine(std::vector<PosedScans>& scans, int passes, const GridOptions& grid,
            const ScanMatcherOptions& matcher, double minFit, int threads,
            const std::optional<ScanMap>& base) {
  const Eigen::Vector3d deviations(0.05, 0.05, mrpt::DEG2RAD(1.0));
  const Eigen::Matrix3d information = deviations.cwiseAbs2().cwiseInverse().asDiagonal();
  const ScanMatcher scanMatcher(matcher);
  tbb::task_arena arena(arenaThreads(threads));
  for (int pass = 0; pass < passes; ++pass) {
    const OccupancyGrid map = gridOf(scans, grid, base);
    parallelFor(arena, base ? 0 : 1, scans.size(), [&](size_t i) {
      TPose2D& pose = scans[i].pose;
      const LaserScans seen = toLaserScans(scans[i].scans, grid.maxRange);
      const ScanBeams beams(seen, BeamSelection(seen).take(matcher.beams));
      const Prior prior = [&, before = pose](const TPose2D& at) {
        return gaussianLogDensity(at, before, information);
      };
      const ScanMatch match = scanMatcher.match(beams, pose, map, prior);
      if (match.fit >= minFit) pose = match.pose;
    });
  }
}

}  // namespace hybrid_slam
