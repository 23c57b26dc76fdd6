/// @file LineMapWeight.h
/// @brief Weight of a particle whose map consists only of its line database: beams against lines.
#pragma once

#include <limits>
#include <vector>

#include "base/Options.h"
#include "slam/grid/ScanBeams.h"
#include "slam/lines/LineDatabase.h"

namespace hybrid_slam {

/// Section [line_map].
struct LineMapOptions : Options {
  double minLength = 1;  ///< m
  int beams = 0;
  double sigma = 0.03;  ///< m
  double inFront = 0.3, random = 0.1;
  double exponent = 30;

  void describe(OptionTable& table) override;
};

/// The nearest line in the direction of a beam.
struct ExpectedWall {
  double range = std::numeric_limits<double>::infinity();  ///< m; infinite: no line within reach
  double sine = 0;                                         ///< of the angle between beam and line
};

/// Casts the beams against the lines of a map (m, map frame). Ignores lines farther from the robot than
/// `reach` (m).
std::vector<ExpectedWall> expectedWalls(const ScanBeams& beams, const mrpt::math::TPose2D& robot,
                                        const std::vector<DatabaseLine>& lines, double reach);

/// A beam model (Thrun, Burgard & Fox, Probabilistic Robotics, Sec. 6.3) on lines. A beam whose nearest line
/// is at the range r and was read as z has the likelihood
///     hit exp(-d^2 / (2 sigma^2)) + c (in_front [z < r] / r + random / z_max),
/// d the distance of its end point from the line, c = sigma sqrt(2 pi), hit = 1 - in_front - random. Where no
/// line is known it is c / z_max: the lines describe only a part of the building. Beams without return are
/// left out, as in w_grid.
class LineMapWeight {
 public:
  /// @param maxRange  z_max (m), which is also the reach of the beams
  LineMapWeight(const LineMapOptions& options, double maxRange);

  /// Mean of the logarithms of the beams' likelihoods, at most 0; 0 for a scan without beams.
  double meanLogLikelihood(const ScanBeams& beams, const mrpt::math::TPose2D& robot,
                           const LineDatabase& lines) const;

 private:
  double maxRange_, information_;  ///< 1 / m^2
  double hit_, inFront_, random_;  ///< the last two with the factor c (m)
  double unknown_;                 ///< likelihood without a line
};

}  // namespace hybrid_slam
