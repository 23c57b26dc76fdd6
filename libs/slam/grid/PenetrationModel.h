/// @file PenetrationModel.h
/// @brief w_grid: the laser-penetration model of DP-SLAM (the paper's [4]) on occupancy log-odds.
#pragma once

#include <array>
#include <vector>

#include "slam/grid/OccupancyGrid.h"

namespace hybrid_slam {

/// Section [grid_weight].
struct GridWeightOptions : Options {
  /// Likelihood of a scan on a particle's grid: the penetration model, or one of the MRPT methods that find
  /// the true pose (the others: doc/mrpt-notes.md).
  enum class Method { penetration, likelihoodField, rayTracing, consensus };
  Method method = Method::penetration;
  double exponent = 25;
  int beams = 45;
  double sigma = 0.08;      ///< m
  double unknownDepth = 8;  ///< m
  double outlier = 0.1;
  void describe(OptionTable& table) override;
};

/// Likelihood of a beam through cells that may each stop it.
///
/// A beam is followed in steps of one cell size s, from the laser to 3 sigma behind the reading z, with step
/// centres d_i = z + (i + 1/2) s, i an integer. Step i stops it with probability P_i: the occupancy of the
/// cell at d_i; 1 - exp(-s / unknown_depth) if the cell is unknown; 0 if it is more likely free than
/// occupied. In DP-SLAM a reading z has the likelihood
///     sum_i [prod_{j<i} (1 - P_j)] P_i exp(-(d_i - z)^2 / (2 sigma^2)),
/// divided by the probability 1 - prod (1 - P) that the beam is stopped.
///
/// Here, consecutive occupied steps form one wall w, and so does each unknown step. A wall stops the beam
/// with probability 1 - prod_w (1 - P), as above, but at any point in it in proportion to P:
///     sum_w [prod_{v<w} (1 - P)] [1 - prod_w (1 - P)] sum_w P_i exp(...) / sum_w P_i.
/// Noise and rounding make walls two or three cells thick. DP-SLAM's sum expects readings at the near side,
/// although they end in the middle, which biases the pose away from the wall ahead: by 0.4 % of a corridor's
/// length (doc/paper-notes.md).
///
/// DP-SLAM weights each cell by the beam's length in it; steps do so on average, in a third of the time.
class PenetrationModel {
 public:
  PenetrationModel(const GridWeightOptions& options, double resolution);

  /// Mean over the beams of ln((1 - outlier) L + outlier), at most 0: the log of the geometric mean of the
  /// beam likelihoods, independent of the number of beams. 0 for a scan without beams.
  double meanLogLikelihood(const ScanBeams& scan, const mrpt::math::TPose2D& robot,
                           const OccupancyGrid& grid) const;

  /// L of one beam, in [0, 1].
  double beamLikelihood(double originX, double originY, double dirX, double dirY, double range,
                        TileReader& cells) const;

 private:
  double resolution_, outlier_;
  std::array<double, 256> passes_;  ///< 1 - P of a step, by cell value + 128
  std::vector<double> density_;     ///< exp(-(d_i - z)^2 / (2 sigma^2)) of the last steps; 0 before them
  int behind_;                      ///< steps behind the reading
};

}  // namespace hybrid_slam
