#include "slam/filter/PreparedScan.h"

#include <algorithm>

#include "slam/features/FeatureDetection.h"
#include "slam/grid/BeamSelection.h"
#include "slam/grid/NarrowThings.h"

namespace hybrid_slam {

ScanPreparation::ScanPreparation(const FilterConfiguration& c)
    : maxRange_(c.grid.maxRange),
      weighedBeams_(c.useGrid ? c.gridWeight.beams : c.lineMap.beams),
      matchedBeams_(c.matcher.beams),
      useLines_(c.useLines),
      lineExtraction_(c.lineExtraction),
      features_(c.features) {}

PreparedScan ScanPreparation::operator()(const Scans& observed) const {
  const LaserScans scans = toLaserScans(observed, maxRange_);
  const BeamSelection selection(scans);
  return {scans,
          ScanBeams(scans),
          ScanBeams(scans, selection.take(weighedBeams_)),
          ScanBeams(scans, selection.take(matchedBeams_)),
          lines(scans),
          features(scans)};
}

PreparedScan ScanPreparation::withoutMovedThings(PreparedScan scan, const mrpt::math::TPose2D& robot,
                                                 const OccupancyGrid& grid) const {
  const std::vector<bool> moved = endsAtMovedThing(scan.beams, robot, grid);
  if (std::find(moved.begin(), moved.end(), true) == moved.end()) return scan;
  const LaserScans still = without(scan.scans, moved);
  const BeamSelection selection(still);
  scan.weighedBeams = ScanBeams(still, selection.take(weighedBeams_));
  scan.matchedBeams = ScanBeams(still, selection.take(matchedBeams_));
  return scan;
}

std::vector<LineSegment> ScanPreparation::lines(const LaserScans& scans) const {
  std::vector<LineSegment> all;
  if (!useLines_) return all;
  for (const LaserScan& scan : scans)
    for (const LineSegment& line : extractLines(scan, lineExtraction_)) all.push_back(line);
  return all;
}

std::vector<PointFeature> ScanPreparation::features(const LaserScans& scans) const {
  std::vector<PointFeature> all;
  if (!features_.enabled) return all;
  for (const LaserScan& scan : scans)
    for (const PointFeature& feature : detectFeatures(scan, lineExtraction_, features_))
      all.push_back(withModelError(feature, features_.sigma));
  return all;
}

}  // namespace hybrid_slam
