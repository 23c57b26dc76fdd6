/// @file PathCovariance.h
/// @brief Uncertainty of a finished path in the map frame: covariance.csv.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <Eigen/Dense>
#include <ostream>
#include <vector>

#include "files/Trajectory.h"
#include "slam/filter/FilterView.h"
#include "slam/loops/PathUncertainty.h"
#include "slam/loops/RevisitCheck.h"

namespace hybrid_slam::run {

/// Covariance of (x, y, phi), map frame; m, rad.
using PoseCovariance = Eigen::Matrix3d;

/// Covariance of the weighted particles; zero without particles.
PoseCovariance covarianceOf(const std::vector<WeightedPose>& particles);

/// A pose at an update of the path, or after it.
struct PathPoint {
  size_t update = 0;         ///< index of the path
  mrpt::math::TPose2D pose;  ///< map frame
};

/// The uncertainty of a finished path. Its drift is a random walk along the path. Where returning scans agree
/// with the map, the path closes a loop: its drift is distributed over the loop if the path is relaxed, else
/// it is that of the shorter way.
class PathCovariances {
 public:
  /// @param path       a pose for each update, map frame
  /// @param particles  the covariance of the particles at each update; those of the last ones may be missing
  /// @param returning  scans compared with what was mapped before; those not contradicted close loops
  /// @param hasLines   line directions keep the heading: the path drifts less
  /// @param isRelaxed  refined, its errors distributed over its loops (PathRelaxation)
  PathCovariances(std::vector<mrpt::math::TPose2D> path, std::vector<PoseCovariance> particles,
                  const std::vector<Revisit>& returning, bool hasLines, bool isRelaxed);

  /// Covariance of each pose of the path: drift since the first one, scan match and spread of the particles;
  /// of a relaxed path with respect to the first pose, so that the scan match of that pose adds to all
  /// others.
  std::vector<PoseCovariance> ofPoses() const;
  /// Covariance of one pose in the frame of another, (x, y, phi): drift between the two, scan match and
  /// motion since the update of each. Without the spread of the particles, most of which is common to both.
  PoseCovariance between(const PathPoint& from, const PathPoint& to) const;

 private:
  /// Of `to` with respect to `from`, but in the directions of the map's axes.
  PoseCovariance inMap(const PathPoint& from, const PathPoint& to) const;
  PoseCovariance driftBetween(size_t from, size_t to) const;
  /// Of the pose within the map, map frame.
  PoseCovariance ofMatch(const PathPoint& point) const;

  std::vector<mrpt::math::TPose2D> path_;
  std::vector<PoseCovariance> particles_;
  bool isRelaxed_;
  PathUncertainty drift_;
  std::vector<KnownPair> loops_;
};

/// Writes `timestamp,xx,xy,yy,xphi,yphi,phiphi`, one row per pose of the trajectory. Between two updates, the
/// covariance of the earlier one grows by the motion since.
/// @param updates  for each row of the trajectory, the number of updates up to it
void writeCovariances(std::ostream& out, const files::Trajectory& trajectory,
                      const std::vector<size_t>& updates, const std::vector<mrpt::math::TPose2D>& path,
                      const std::vector<PoseCovariance>& covariances);

}  // namespace hybrid_slam::run
