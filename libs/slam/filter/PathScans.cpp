#include "slam/filter/PathScans.h"

#include <algorithm>

#include "base/PoseDistance.h"
#include "slam/grid/BeamSelection.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;

PathScans::PathScans(const std::vector<TPose2D>& path, const std::vector<Scans>& scans,
                     const FilterConfiguration& configuration)
    : path_(path),
      scans_(scans),
      configuration_(configuration),
      matcher_(configuration.matcher),
      distances_(lengthsAlong(path)) {}

size_t PathScans::firstFrom(double distance) const {
  return static_cast<size_t>(std::lower_bound(distances_.begin(), distances_.end(), distance) -
                             distances_.begin());
}

void PathScans::insert(size_t i, const TPose2D& pose, OccupancyGrid& map) const {
  map.insert(ScanBeams(toLaserScans(scans_[i], configuration_.grid.maxRange)), pose,
             hitsAlone(configuration_.grid));
}

ScanBeams PathScans::beams(size_t i) const {
  const LaserScans seen = toLaserScans(scans_[i], configuration_.grid.maxRange);
  return ScanBeams(seen, BeamSelection(seen).take(configuration_.matcher.beams));
}

ScanLikelihood PathScans::likelihood(const ScanBeams& beams, const OccupancyGrid& map) const {
  return matcher_.likelihood(beams, map);
}

ScanMatch PathScans::match(ScanLikelihood& likelihood, const TPose2D& start, const TPose2D& pose,
                           const Eigen::Matrix3d& covariance) const {
  const Eigen::Matrix3d information = covariance.inverse();
  return matcher_.match(likelihood, start,
                        [&](const TPose2D& at) { return gaussianLogDensity(at, pose, information); });
}

}  // namespace hybrid_slam
