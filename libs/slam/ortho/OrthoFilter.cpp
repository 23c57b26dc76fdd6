#include "slam/ortho/OrthoFilter.h"

#include <mrpt/math/wrap2pi.h>

#include <cmath>

#include "slam/grid/GridConversion.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;
using mrpt::system::CTimeLoggerEntry;

OrthoFilter::OrthoFilter(const FilterConfiguration& c, const OrthoOptions& options)
    : interval_(c.updateInterval()),
      motion_(c.motion),
      maxRange_(c.grid.maxRange),
      prepare_(c),
      map_(options, c.database),
      pathGrid_(c.grid) {
  checkMemory(c.grid, c.gridWeight);
}

void OrthoFilter::process(const TPose2D& odometry, const Scans& scans) {
  expectFinite(odometry);
  odometry_ = odometry_ + odometry;
  if (scans.empty() || !(path_.empty() || interval_.isOver(odometry_))) return;

  CTimeLoggerEntry preparing(profiler(), "2 prepare scan, extract lines");
  const std::vector<LineSegment> seen = prepare_.lines(toLaserScans(scans, maxRange_));
  preparing.stop();
  const CTimeLoggerEntry updating(profiler(), "3 update pose and lines");
  map_.move(odometry_, motion_);
  map_.update(seen);
  odometry_ = TPose2D();
  path_.push_back(map_.pose());
  scans_.push_back(scans);

  step_ = FilterStep();
  step_.particles = 1;
  step_.resampled = false;
  step_.linesSeen = static_cast<int>(seen.size());
  step_.linesMatched = map_.matched();
  if (map_.direction()) step_.frames = directionFrames(map_.lines());
  setSpread(step_, particlePoses(), map_.pose().phi);
}

mrpt::maps::COccupancyGridMap2D OrthoFilter::bestGrid() const { return toMrpt(pathGrid_.of(path_, scans_)); }

std::vector<WeightedPose> OrthoFilter::particlePoses() const {
  const Eigen::Matrix3d covariance = 3 * map_.poseCovariance();
  const Eigen::LDLT<Eigen::Matrix3d> factor(covariance);
  const Eigen::Matrix3d root = factor.transpositionsP().transpose() * Eigen::Matrix3d(factor.matrixL()) *
                               Eigen::Vector3d(factor.vectorD().cwiseMax(0).cwiseSqrt()).asDiagonal();
  const TPose2D pose = map_.pose();
  std::vector<WeightedPose> all;
  for (int i = 0; i < 3; ++i)
    for (const double sign : {-1, 1}) {
      const Eigen::Vector3d off = sign * root.col(i);
      all.push_back({{pose.x + off.x(), pose.y + off.y(), mrpt::math::wrapToPi(pose.phi + off.z())}, 0});
    }
  return all;
}

}  // namespace hybrid_slam
