#include "grid/PenetrationModel.h"

#include <algorithm>
#include <cmath>

#include "grid/RayTraversal.h"

namespace hybrid_slam {

void GridWeightOptions::describe(OptionTable& t) {
  t.add(
      "method", method,
      {{Method::penetration, "penetration"},
       {Method::likelihoodField, "likelihood_field"},
       {Method::rayTracing, "ray_tracing"},
       {Method::consensus, "consensus"}},
      "laser penetration as in the paper's [4], or one of MRPT's likelihood methods (slow: for comparison)");
  t.add("exponent", exponent, 0, 1000, "",
        "tempering: w_grid = (geometric mean of the beams' likelihoods)^exponent, as if so many beams were "
        "independent");
  t.add("beam_step", beamStep, 1, 100, "weighs every n-th beam");
  t.add("sigma", sigma, 0.005, 2, "m", "standard deviation of a range against the grid");
  t.add("unknown_depth", unknownDepth, 0.1, 1000, "m", "mean distance that a beam travels in unseen cells");
  t.add("outlier", outlier, 1e-6, 0.99, "",
        "share of readings that the map does not explain (people, doors)");
}

PenetrationModel::PenetrationModel(const GridWeightOptions& options, double resolution)
    : resolution_(resolution),
      outlier_(options.outlier),
      halfInverseVariance_(0.5 * std::pow(resolution / options.sigma, 2)),
      window_(3 * options.sigma / resolution) {
  for (int value = -128; value < 128; ++value) {
    double& opacity = opacity_[static_cast<size_t>(value + 128)];
    if (value == 0)
      opacity = resolution / options.unknownDepth;
    else
      opacity = value < 0 ? 0 : std::log1p(std::exp(OccupancyGrid::kLogOddsScale * value));  // -ln(1 - p)
  }
}

double PenetrationModel::beamLikelihood(double originX, double originY, double dirX, double dirY,
                                        double range, TileReader& cells) const {
  constexpr double kOpaque = 30;                   // exp(-30): nothing gets through
  double depth = 0, passing = -1;                  // optical depth so far; exp(-depth), once it is needed
  double stoppedNearRange = 0;                     // the sum of the formula
  const double windowStart = range - 2 * window_;  // exp(-18) at 6 sigma: nothing is added before
  traverseRay(originX, originY, dirX, dirY, range + window_, [&](int x, int y, double entry, double exit) {
    const double opacity = opacity_[static_cast<size_t>(cells.at(x, y) + 128)];
    if (opacity == 0) return true;
    if (exit >= windowStart && passing < 0) passing = std::exp(-depth);
    depth += opacity * (exit - entry);
    if (exit < windowStart) return depth < kOpaque;
    const double passed = std::exp(-depth);
    const double off = 0.5 * (entry + exit) - range;
    stoppedNearRange += (passing - passed) * std::exp(-off * off * halfInverseVariance_);
    passing = passed;
    return depth < kOpaque;
  });
  const double stopped = 1 - std::exp(-depth);
  return stopped > 0 ? std::min(stoppedNearRange / stopped, 1.0) : 0;
}

double PenetrationModel::meanLogLikelihood(const ScanBeams& scan, const mrpt::math::TPose2D& robot,
                                           const OccupancyGrid& grid) const {
  if (scan.rays.empty()) return 0;
  const GridPose pose(robot, scan, resolution_);
  TileReader cells(grid.tiles());
  double sum = 0;
  for (const auto& ray : scan.rays) {
    const double likelihood = beamLikelihood(pose.originX, pose.originY, pose.dirX(ray), pose.dirY(ray),
                                             ray.range / resolution_, cells);
    sum += std::log((1 - outlier_) * likelihood + outlier_);
  }
  return sum / static_cast<double>(scan.rays.size());
}

}  // namespace hybrid_slam
