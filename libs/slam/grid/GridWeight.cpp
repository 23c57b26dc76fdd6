#include "slam/grid/GridWeight.h"

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose3D.h>

#include <algorithm>
#include <cmath>

#include "base/Memory.h"
#include "slam/grid/GridConversion.h"

namespace hybrid_slam {
namespace {

using MrptGrid = mrpt::maps::COccupancyGridMap2D;
using Method = GridWeightOptions::Method;

MrptGrid::TLikelihoodMethod mrptMethod(Method method) {
  switch (method) {
    case Method::likelihoodField:
      return MrptGrid::lmLikelihoodField_Thrun;
    case Method::rayTracing:
      return MrptGrid::lmRayTracing;
    default:
      return MrptGrid::lmConsensus;
  }
}

/// The scan as seen from above, with valid beams only: MRPT's methods use invalid beams, read outside the
/// grid for long ones, and give tilted scans no weight.
mrpt::obs::CObservation2DRangeScan toObservation(const LaserScan& scan) {
  mrpt::obs::CObservation2DRangeScan out;
  out.aperture = static_cast<float>(scan.beams.back().angle - scan.beams.front().angle);
  out.rightToLeft = true;
  out.maxRange = static_cast<float>(scan.maxRange);
  out.sensorPose = mrpt::poses::CPose3D(scan.sensorPose);
  resizeScan(out, scan.beams.size());
  for (size_t i = 0; i < scan.beams.size(); ++i) {
    const Beam& beam = scan.beams[i];
    out.setScanRange(i, beam.valid ? static_cast<float>(beam.range) : 0);
    out.setScanRangeValidity(i, beam.valid);
  }
  return out;
}

/// Step that keeps about `beams` of `count` beams, evenly spaced; 0: all.
size_t decimation(size_t count, int beams) {
  if (beams == 0) return 1;
  return std::max<size_t>(1, (2 * count + static_cast<size_t>(beams)) / (2 * static_cast<size_t>(beams)));
}

/// The cells within reach of the longest beam: MRPT uses all beams, and reads outside the grid.
CellBox reach(const LaserScans& scans, const mrpt::math::TPose2D& robot, const OccupancyGrid& grid) {
  double reach = 0;
  for (const LaserScan& scan : scans)
    for (const Beam& beam : scan.beams)
      if (beam.valid) reach = std::max(reach, beam.range + scan.sensorPose.norm() + 1);
  return {grid.cellOf(robot.x - reach, robot.y - reach), grid.cellOf(robot.x + reach, robot.y + reach)};
}

}  // namespace

// w_grid of Sec. III-D. The penetration model follows the paper's [4]; MRPT's methods are alternatives.
double GridWeight::logWeight(const ScanBeams& beams, const LaserScans& scans,
                             const mrpt::math::TPose2D& robot, const OccupancyGrid& grid) const {
  if (options_.method == Method::penetration) return penetration_.meanLogLikelihood(beams, robot, grid);
  if (beams.rays.empty()) return 0;

  MrptGrid local = toMrpt(grid, reach(scans, robot, grid));
  auto& options = local.likelihoodOptions;
  options.likelihoodMethod = mrptMethod(options_.method);
  options.LF_stdHit = options.rayTracing_stdHit = static_cast<float>(options_.sigma);
  const bool isMean = options_.method == Method::consensus;
  double sum = 0;
  for (const LaserScan& scan : scans) {
    const auto valid =
        std::count_if(scan.beams.begin(), scan.beams.end(), [](const Beam& b) { return b.valid; });
    if (valid == 0 || scan.beams.size() < 2) continue;  // MRPT takes no scan of one beam
    const size_t step = decimation(scan.beams.size(), options_.beams);
    options.LF_decimation = static_cast<uint32_t>(step);
    options.rayTracing_decimation = options.consensus_takeEachRange = static_cast<int>(step);
    // A separate scan for each call: MRPT caches the points in it without a lock.
    const double logLikelihood =
        local.computeObservationLikelihood(toObservation(scan), mrpt::poses::CPose3D(robot));
    sum += isMean ? logLikelihood * static_cast<double>(valid) : logLikelihood;
  }
  return std::min(0.0, sum / static_cast<double>(beams.rays.size()));
}

}  // namespace hybrid_slam
