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
  t.add("beams", beams, 0, 10000, "weighs about so many beams of a scan, evenly spread; 0: all");
  t.add("sigma", sigma, 0.005, 2, "m", "standard deviation of a range against the grid");
  t.add("unknown_depth", unknownDepth, 0.1, 1000, "m", "mean distance that a beam travels in unseen cells");
  t.add("outlier", outlier, 1e-6, 0.99, "",
        "share of readings that the map does not explain (people, doors)");
}

namespace {

/// exp(-x) for x in [0, kLargest], to 1e-11 of it: a table, and the next terms of the series from there.
class NegativeExponential {
 public:
  static constexpr int kLargest = 40;
  NegativeExponential() {
    for (size_t i = 0; i < nodes_.size(); ++i) nodes_[i] = std::exp(-static_cast<double>(i) / kPerUnit);
  }
  double operator()(double x) const {
    const int nearest = static_cast<int>(x * kPerUnit + 0.5);
    const double rest = nearest * (1.0 / kPerUnit) - x;
    const double square = rest * rest;
    return nodes_[static_cast<size_t>(nearest)] *
           ((1 + rest) + square * ((1.0 / 2 + (1.0 / 6) * rest) + (1.0 / 24) * square));
  }

 private:
  static constexpr int kPerUnit = 32;
  std::array<double, kLargest * kPerUnit + 1> nodes_;
};

const NegativeExponential negativeExp;

}  // namespace

PenetrationModel::PenetrationModel(const GridWeightOptions& options, double resolution)
    : resolution_(resolution),
      outlier_(options.outlier),
      perSigma_(resolution / options.sigma),
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
  constexpr double kOpaque = 25;                   // exp(-25): nothing gets through
  double depth = 0, passing = -1;                  // optical depth so far; exp(-depth), once it is needed
  double stoppedNearRange = 0;                     // the sum of the formula
  const double windowStart = range - 2 * window_;  // exp(-18) at 6 sigma: nothing is added before
  traverseObstacles(
      cells, originX, originY, dirX, dirY,
      range + window_, [&](int8_t cell, double entry, double exit) __attribute__((always_inline)) {
        if (cell < 0) return true;
        const double opacity = opacity_[static_cast<size_t>(cell + 128)];
        const double met = opacity * (exit - entry);
        const double middle = 0.5 * (entry + exit);
        depth += met;
        if (middle < windowStart) return depth < kOpaque;
        if (passing < 0) passing = negativeExp(depth - met);
        const double passed = passing * negativeExp(met);
        const double off = (middle - range) * perSigma_;
        stoppedNearRange += (passing - passed) * negativeExp(0.5 * off * off);
        passing = passed;
        return depth < kOpaque;
      });
  const double stopped = 1 - (passing < 0 ? negativeExp(depth) : passing);
  return stopped > 0 ? std::min(stoppedNearRange / stopped, 1.0) : 0;
}

double PenetrationModel::meanLogLikelihood(const ScanBeams& scan, const mrpt::math::TPose2D& robot,
                                           const OccupancyGrid& grid) const {
  if (scan.rays.empty()) return 0;
  const GridPose pose(robot, scan, resolution_);
  TileReader cells(grid.tiles());
  double sum = 0, product = 1;  // of so many beams that it cannot underflow: one logarithm for all
  for (const auto& ray : scan.rays) {
    const double likelihood = beamLikelihood(pose.originX, pose.originY, pose.dirX(ray), pose.dirY(ray),
                                             ray.range / resolution_, cells);
    product *= (1 - outlier_) * likelihood + outlier_;
    if (product > 1e-100) continue;
    sum += std::log(product);
    product = 1;
  }
  sum += std::log(product);
  return sum / static_cast<double>(scan.rays.size());
}

}  // namespace hybrid_slam
