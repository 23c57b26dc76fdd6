#include "slam/filter/MapMaker.h"

namespace hybrid_slam {

OccupancyGrid gridOf(const std::vector<PosedScans>& scans, const GridOptions& options,
                     const std::optional<ScanMap>& base) {
  OccupancyGrid grid = base ? base->grid : OccupancyGrid(options.resolution);
  for (const PosedScans& posed : scans)
    if (posed.isMapped)
      grid.insert(ScanBeams(toLaserScans(posed.scans, options.maxRange)), posed.pose, options);
  return grid;
}

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

}  // namespace hybrid_slam
