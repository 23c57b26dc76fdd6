/// @file LineLikelihood.h
/// @brief Likelihood of a scan's lines given a particle's pose, for the improved proposal.
#pragma once

#include <memory>
#include <vector>

#include "slam/filter/FilterOptions.h"
#include "slam/grid/ScanMatcher.h"

namespace hybrid_slam {

/// Settings of LineLikelihood.
struct LineLikelihoodOptions {
  /// @param leastCount  min_count of [line_database]
  LineLikelihoodOptions(const LineWeightOptions& lineWeight, const AssociationOptions& lineAssociation,
                        int leastCount, const ImprovedProposalOptions& improved);
  LineWeightOptions weight;  ///< with the improved proposal's line_sigma
  double sigmaRho;           ///< m
  AssociationOptions association;
  int minCount;
};

/// ln p(lines | pose, line database), up to a constant. It is the sum of two parts:
///
/// - Lines of unknown walls (no association, or observed fewer than min_count times) are compared with the
///   database's directions: ln w_line over these lines alone.
/// - A line of a known wall is compared with it, by its angle and its midpoint's distance:
///   - l / L min(angle^2 / sigma^2 + distance^2 / sigma_rho^2, 9) / 2, l its length and L that of all lines.
///   Its direction relative to other walls is not used again: over time, this would rotate a wall that is
///   2 deg off the others, and the map with it.
///
/// Lines are associated once, at the predicted pose: the motion model's mean or, after a slip, the search
/// result.
class LineLikelihood {
 public:
  /// @param seen       robot frame
  /// @param database   map frame; must outlive this
  LineLikelihood(const std::vector<LineSegment>& seen, const mrpt::math::TPose2D& predicted,
                 const LineDatabase& database, const LineLikelihoodOptions& options);

  LogDensity operator()(const mrpt::math::TPose2D& pose) const;

 private:
  struct KnownWall {
    mrpt::math::TPoint2D middle;  ///< of the observed line, robot frame, m
    double theta;                 ///< of the observed line, robot frame, rad
    double knownRho, knownTheta;  ///< of the wall, map frame
    double normalX, normalY;      ///< cosine and sine of knownTheta
    double share;                 ///< l / L
  };
  std::shared_ptr<const LineDatabase> compared_;
  LineWeightOptions weight_;
  double sigmaRho_;
  std::vector<LineSegment> newLines_;
  std::vector<KnownWall> walls_;
};

/// ln w_line as a function of the heading; constant at the floor.
LogDensity lineLogDensity(const std::vector<LineSegment>& seen, double heading, const LineDatabase& database,
                          const LineWeightOptions& options);

}  // namespace hybrid_slam
