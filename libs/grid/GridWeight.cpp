#include "grid/GridWeight.h"

#include <mrpt/poses/CPose3D.h>

#include <algorithm>
#include <cmath>

#include "grid/GridConversion.h"

namespace hybrid_slam {
namespace {

using MrptGrid = mrpt::maps::COccupancyGridMap2D;
using Method = GridWeightOptions::Method;

MrptGrid::TLikelihoodMethod mrptMethod(Method method) {
  switch (method) {
    case Method::likelihoodField:
      return MrptGrid::lmLikelihoodField_Thrun;
    case Method::likelihoodFieldII:
      return MrptGrid::lmLikelihoodField_II;
    case Method::rayTracing:
      return MrptGrid::lmRayTracing;
    case Method::consensus:
      return MrptGrid::lmConsensus;
    case Method::consensusOwa:
      return MrptGrid::lmConsensusOWA;
    case Method::cellsDifference:
      return MrptGrid::lmCellsDifference;
    default:
      return MrptGrid::lmMeanInformation;
  }
}

/// The cells within reach of the scan's longest beam.
CellBox reach(const ScanBeams& beams, const mrpt::math::TPose2D& robot, const OccupancyGrid& grid) {
  double longest = 0;
  for (const auto& ray : beams.rays) longest = std::max(longest, ray.range);
  const double reach = longest + std::hypot(beams.originX, beams.originY) + 1;
  return {grid.cellOf(robot.x - reach, robot.y - reach), grid.cellOf(robot.x + reach, robot.y + reach)};
}

}  // namespace

double GridWeight::logWeight(const ScanBeams& beams, const mrpt::obs::CObservation2DRangeScan& scan,
                             const mrpt::math::TPose2D& robot, const OccupancyGrid& grid) const {
  if (options_.method == Method::penetration) return penetration_.meanLogLikelihood(beams, robot, grid);
  if (beams.rays.empty()) return 0;

  MrptGrid local = toMrpt(grid, reach(beams, robot, grid));
  local.likelihoodOptions.likelihoodMethod = mrptMethod(options_.method);
  local.likelihoodOptions.LF_stdHit = static_cast<float>(options_.sigma);
  local.likelihoodOptions.LF_decimation = static_cast<uint32_t>(options_.beamStep);
  local.likelihoodOptions.rayTracing_stdHit = static_cast<float>(options_.sigma);
  const double logLikelihood = local.computeObservationLikelihood(scan, mrpt::poses::CPose3D(robot));
  return std::min(0.0, logLikelihood / static_cast<double>(beams.rays.size()));
}

}  // namespace hybrid_slam
