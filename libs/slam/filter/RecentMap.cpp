#include "slam/filter/RecentMap.h"

namespace hybrid_slam {

void RecentMap::add(const ScanBeams& scan) {
  scans_.push_back(scan);
  if (scans_.size() > kScans) scans_.pop_front();
}

OccupancyGrid RecentMap::map(const Path& path, size_t skip) const {
  OccupancyGrid map(grid_.resolution);
  const std::vector<mrpt::math::TPose2D> poses = path.newest(scans_.size());
  const size_t first = scans_.size() - poses.size();
  for (size_t i = 0; i + skip < poses.size(); ++i) map.insert(scans_[first + i], poses[i], hitsAlone(grid_));
  return map;
}

}  // namespace hybrid_slam
