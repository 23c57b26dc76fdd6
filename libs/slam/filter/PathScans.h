/// @file PathScans.h
/// @brief The scans along a path, inserted in maps and matched to maps.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <vector>

#include "base/LaserScan.h"
#include "slam/filter/FilterOptions.h"
#include "slam/grid/ScanMatcher.h"

namespace hybrid_slam {

/// Path, scans and configuration must outlive it.
class PathScans {
 public:
  /// @param path   a pose for each update, map frame
  /// @param scans  of each update; those of the last ones may be missing
  PathScans(const std::vector<mrpt::math::TPose2D>& path, const std::vector<Scans>& scans,
            const FilterConfiguration& configuration);

  const std::vector<mrpt::math::TPose2D>& path() const { return path_; }
  /// Length of the path up to update i, m.
  double distance(size_t i) const { return distances_[i]; }
  /// First update at this length of the path (m) or after it; the number of poses if there is none.
  size_t firstFrom(double distance) const;

  double resolution() const { return configuration_.grid.resolution; }
  /// Inserts scan i at `pose` (map frame).
  void insert(size_t i, const mrpt::math::TPose2D& pose, OccupancyGrid& map) const;
  /// Returns the beams of scan i that are matched.
  ScanBeams beams(size_t i) const;
  /// Both must outlive the likelihood.
  ScanLikelihood likelihood(const ScanBeams& beams, const OccupancyGrid& map) const;
  ScanLikelihood likelihood(ScanBeams&&, const OccupancyGrid&) const = delete;
  /// Matches a scan from `start`; it is expected at `pose` with this covariance (map axes).
  ScanMatch match(ScanLikelihood& likelihood, const mrpt::math::TPose2D& start,
                  const mrpt::math::TPose2D& pose, const Eigen::Matrix3d& covariance) const;

 private:
  const std::vector<mrpt::math::TPose2D>& path_;
  const std::vector<Scans>& scans_;
  const FilterConfiguration& configuration_;
  ScanMatcher matcher_;
  std::vector<double> distances_;  ///< m, along the path
};

/// Returns the covariance of independent x, y (m) and heading (rad).
inline Eigen::Matrix3d covarianceOf(const Eigen::Vector3d& deviations) {
  return deviations.cwiseAbs2().asDiagonal();
}

}  // namespace hybrid_slam
