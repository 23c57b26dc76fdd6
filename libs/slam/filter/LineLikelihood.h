/// @file LineLikelihood.h
/// @brief What the lines of a scan say of a particle's pose: the lines' part in the improved proposal.
#pragma once

#include <vector>

#include "slam/filter/FilterOptions.h"
#include "slam/grid/ScanMatcher.h"

namespace hybrid_slam {

/// What LineLikelihood uses of the settings.
struct LineLikelihoodOptions {
  explicit LineLikelihoodOptions(const FilterConfiguration& configuration);
  LineWeightOptions weight;  ///< with the improved proposal's line_sigma
  double sigmaRho;           ///< m
  AssociationOptions association;
  int minCount;
};

/// ln p(lines | pose, line database), up to a constant. It is the sum of two parts:
///
/// - Lines of walls that the database does not know (nothing associated, or seen fewer than min_count times)
///   count against the database's directions: ln w_line over these lines alone.
/// - A line of a known wall counts against this wall, by its angle to it and its middle's distance from it:
///   - l / L min(angle^2 / sigma^2 + distance^2 / sigma_rho^2, 9) / 2, l its length and L that of all lines.
///   How the wall lies to the others was settled when it was new; to ask again in each scan would turn a
///   wall that runs 2 deg off the others, and the map with it, bit by bit.
///
/// Lines are associated once, at the predicted pose: the motion model's mean or, after a slip, where the
/// search found the robot.
class LineLikelihood {
 public:
  /// @param seen       robot frame
  /// @param database   map frame; must outlive this
  LineLikelihood(const std::vector<LineSegment>& seen, const mrpt::math::TPose2D& predicted,
                 const LineDatabase& database, const LineLikelihoodOptions& options);

  LogDensity operator()(const mrpt::math::TPose2D& pose) const;

 private:
  struct KnownWall {
    mrpt::math::TPoint2D middle;  ///< of the line seen, robot frame, m
    double theta;                 ///< of the line seen, robot frame, rad
    double knownRho, knownTheta;  ///< of the wall, map frame
    double normalX, normalY;      ///< cosine and sine of knownTheta
    double share;                 ///< l / L
  };
  const LineDatabase& database_;
  LineWeightOptions weight_;
  double sigmaRho_;
  std::vector<LineSegment> newLines_;
  std::vector<KnownWall> walls_;
};

/// ln w_line as a function of the heading; constant at the floor.
LogDensity lineLogDensity(const std::vector<LineSegment>& seen, double heading, const LineDatabase& database,
                          const LineWeightOptions& options);

}  // namespace hybrid_slam
