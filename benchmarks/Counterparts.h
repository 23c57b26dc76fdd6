/// @file Counterparts.h
/// @brief The precision of lines without ground truth: from the differences between lines of two scans that
/// show the same wall.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "slam/lines/LineAssociation.h"

namespace hybrid_slam::bench {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

/// Two lines that show the same wall, in the frame of the first scan's robot.
struct Counterpart {
  LineSegment first, second;
};

/// Returns the lines of the second scan that have a counterpart in the first, by [line_association].
/// @param motion  pose of the second scan's robot in the frame of the first's
inline std::vector<Counterpart> counterparts(const std::vector<LineSegment>& first,
                                             const std::vector<LineSegment>& second, const TPose2D& motion) {
  const AssociationOptions options;
  std::vector<Counterpart> result;
  for (const LineSegment& line : transformed(second, motion)) {
    const LineSegment* nearest = nullptr;
    double least = 0;
    for (const LineSegment& other : first) {
      const auto distance = matchDistance(line, other, options);
      if (distance && (!nearest || *distance < least)) nearest = &other, least = *distance;
    }
    if (nearest) result.push_back({*nearest, line});
  }
  return result;
}

/// Differences between counterparts, without what an error of the motion between the two scans explains. Each
/// is an independent sample of the difference between two errors of a line: its sigma is sqrt(2) times that
/// of a line.
class Differences {
 public:
  std::vector<double> angles, distances;  ///< rad, m

  /// Adds the counterparts of a pair of scans.
  ///
  /// An error of the heading turns all lines alike. The distance between counterparts is that of their
  /// middles across their mean direction, so that an error of a line's direction hardly enters it. An error
  /// (x, y, phi) of the motion changes it by (x, y) along the normal, and by phi times the place along the
  /// wall. The mean turn does not give this phi: at a few metres along a wall, its error exceeds that of the
  /// distance.
  void add(const std::vector<Counterpart>& pairs) {
    const auto n = static_cast<Eigen::Index>(pairs.size());
    if (n < 2) return;
    Eigen::VectorXd turns(n), offsets(n);
    Eigen::MatrixXd effect(n, 3);  // of x, y, phi on the offsets
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto& [first, second] = pairs[static_cast<size_t>(i)];
      turns[i] = halfTurnDifference(second.theta, first.theta);
      const double theta = first.theta + turns[i] / 2, c = std::cos(theta), s = std::sin(theta);
      const TPoint2D a = middle(first), b = middle(second);
      offsets[i] = (b.x - a.x) * c + (b.y - a.y) * s;
      effect.row(i) << c, s, (a.x + b.x) / 2 * s - (a.y + b.y) / 2 * c;
    }
    addUnexplained(turns, Eigen::MatrixXd::Ones(n, 1), angles);
    addUnexplained(offsets, effect, distances);
  }

 private:
  /// Appends the components of `values` orthogonal to the columns of `effect`: one for each degree of freedom
  /// that least squares leave.
  static void addUnexplained(const Eigen::VectorXd& values, const Eigen::MatrixXd& effect,
                             std::vector<double>& result) {
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver;
    solver.setThreshold(1e-9);  // parallel walls do not tell x, y and phi apart
    solver.compute(effect);
    const Eigen::VectorXd components = solver.householderQ().adjoint() * values;
    result.insert(result.end(), components.begin() + solver.rank(), components.end());
  }
};

}  // namespace hybrid_slam::bench
