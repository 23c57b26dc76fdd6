/// @file PenetrationModel.h
/// @brief w_grid: the laser-penetration model of DP-SLAM (the paper's [4]) on occupancy log-odds.
#pragma once

#include <array>

#include "grid/OccupancyGrid.h"

namespace hybrid_slam {

/// Section [grid_weight].
struct GridWeightOptions : Options {
  /// How a scan is scored on a particle's grid: the penetration model, or one of those MRPT
  /// methods that find the true pose (doc/mrpt-notes.md tells of the others).
  enum class Method { penetration, likelihoodField, rayTracing, consensus };
  Method method = Method::penetration;
  double exponent = 30;
  int beams = 90;
  double sigma = 0.13;
  double unknownDepth = 8;
  double outlier = 0.1;
  void describe(OptionTable& table) override;
};

/// The likelihood of a beam that travels through cells which each may stop it.
///
/// A cell of opacity k (1/m) stops a beam that crosses x metres of it with P = 1 - exp(-k x). A beam that
/// read z has the likelihood  sum_i [prod_{j<i} (1 - P_j)] P_i exp(-(d_i - z)^2 / (2 sigma^2))  over the
/// cells i along it, to 3 sigma behind z, divided by the chance 1 - prod (1 - P) that it is stopped at all.
/// The opacity follows from the occupancy p of a cell of size s: k = -ln(1 - p) / s, so that P = p where the
/// beam crosses s metres of it; a cell never seen has k = 1 / unknown_depth; one that was seen and is more
/// likely free than not lets every beam through.
class PenetrationModel {
 public:
  PenetrationModel(const GridWeightOptions& options, double resolution);

  /// Mean over the beams of ln((1 - outlier) L + outlier), never above 0: the logarithm of the geometric mean
  /// of the beams' likelihoods, which does not depend on the number of beams. 0 for a scan without beams.
  double meanLogLikelihood(const ScanBeams& scan, const mrpt::math::TPose2D& robot,
                           const OccupancyGrid& grid) const;

  /// L of one beam, in [0, 1].
  double beamLikelihood(double originX, double originY, double dirX, double dirY, double range,
                        TileReader& cells) const;

 private:
  std::array<double, 256> opacity_;  ///< by cell value + 128, per cell length
  double resolution_, outlier_;
  double perSigma_, window_;  ///< sigmas per cell; 3 sigma in cells
};

}  // namespace hybrid_slam
