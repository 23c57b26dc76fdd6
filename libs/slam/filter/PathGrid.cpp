#include "slam/filter/PathGrid.h"

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <algorithm>

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {
constexpr size_t kOpen = 50;  // poses
}

PathGrid::PathGrid(const GridOptions& options)
    : options_(options), settled_(options.resolution), whole_(options.resolution) {}

const OccupancyGrid& PathGrid::of(const std::vector<TPose2D>& path, const std::vector<Scans>& scans) {
  const auto insert = [&](OccupancyGrid& grid, size_t i) {
    grid.insert(ScanBeams(toLaserScans(scans[i], options_.maxRange)), path[i], options_);
  };
  const size_t count = std::min(path.size(), scans.size());
  if (count < settledPath_.size() || !std::equal(settledPath_.begin(), settledPath_.end(), path.begin())) {
    settledPath_.clear();
    settled_ = OccupancyGrid(options_.resolution);
  }
  for (size_t i = settledPath_.size(); i + kOpen < count; ++i) {
    insert(settled_, i);
    settledPath_.push_back(path[i]);
  }
  whole_ = settled_;
  for (size_t i = settledPath_.size(); i < count; ++i) insert(whole_, i);
  return whole_;
}

}  // namespace hybrid_slam
