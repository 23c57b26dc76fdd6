/// @file PenetrationModel.h
/// @brief w_grid: the laser-penetration model of DP-SLAM (the paper's [4]) on occupancy log-odds.
#pragma once

#include <array>
#include <vector>

#include "slam/grid/OccupancyGrid.h"

namespace hybrid_slam {

/// Section [grid_weight].
struct GridWeightOptions : Options {
  /// How a scan is scored on a particle's grid: the penetration model, or one of those MRPT
  /// methods that find the true pose (doc/mrpt-notes.md tells of the others).
  enum class Method { penetration, likelihoodField, rayTracing, consensus };
  Method method = Method::penetration;
  double exponent = 25;
  int beams = 45;
  double sigma = 0.08;
  double unknownDepth = 8;
  double outlier = 0.1;
  void describe(OptionTable& table) override;
};

/// The likelihood of a beam that travels through cells which each may stop it.
///
/// A beam is followed in steps of a cell's length s, from the laser to 3 sigma behind the reading z; the
/// middles d_i of the steps lie at z + (i + 1/2) s, whole i. Step i stops it with P_i, the occupancy of the
/// cell that d_i lies in; with 1 - exp(-s / unknown_depth) where nothing was seen yet; not at all where a
/// cell was seen and is more likely free than not. DP-SLAM gives a reading z the likelihood
///     sum_i [prod_{j<i} (1 - P_j)] P_i exp(-(d_i - z)^2 / (2 sigma^2)),
/// divided by the chance 1 - prod (1 - P) that the beam is stopped at all.
///
/// Here, occupied steps that follow one another are one wall w, and so is each unknown step. A wall stops
/// the beam with 1 - prod_w (1 - P), as above, but anywhere in it by share of P:
///     sum_w [prod_{v<w} (1 - P)] [1 - prod_w (1 - P)] sum_w P_i exp(...) / sum_w P_i.
/// Noise and rounding make walls two or three cells thick. DP-SLAM's sum expects a reading at their near
/// side, though it was in the middle of them that readings ended, and holds the robot back from the walls
/// ahead of it: by 0.4 % of a corridor's length (doc/accuracy.md).
///
/// DP-SLAM weighs each cell by the length that the beam has in it; with steps this is so on average, and
/// takes a third of the time.
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
  double resolution_, outlier_;
  std::array<double, 256> passes_;  ///< 1 - P of a step, by cell value + 128
  std::vector<double> density_;     ///< exp(-(d_i - z)^2 / (2 sigma^2)) of the last steps; before, it is 0
  int behind_;                      ///< steps behind the reading
};

}  // namespace hybrid_slam
