/// @file PathUncertainty.h
/// @brief Uncertainty of a pose of a path relative to another one.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <Eigen/Dense>
#include <limits>
#include <optional>
#include <vector>

namespace hybrid_slam {

/// Variances of a motion of the path after scan matching.
struct StepVariance {
  double position = 0;  ///< m^2, in x and in y
  double heading = 0;   ///< rad^2
  static constexpr double kMost = 1e6;
  /// Returns whether it is invertible: it is of a motion, not zero.
  bool isOfMotion() const { return position > 1e-9 && heading > 1e-9; }

  template <class State>
  void visit(State& state) {
    state(position, heading);
    state.check(0 <= position && position <= kMost && 0 <= heading && heading <= kMost,
                "a variance is impossible");
  }
};

/// The error that loop closing allows for: a random walk of 5 cm and 0.25 deg per sqrt(m), and 1 % of a
/// rotation. Another 0.3 m and 5 deg if the odometry slipped and a search replaced it. These bounds exceed
/// the usual drift of a path (PathDrift), because a loop outside of them is not found.
StepVariance stepVariance(const mrpt::math::TPose2D& motion, bool hasSlipped);

/// Two poses of the path whose relative pose has been measured, or a pose measured in the map.
struct KnownPair {
  static constexpr size_t kMapFrame = std::numeric_limits<size_t>::max();  ///< `earlier` of a pose in the map
  size_t earlier = 0, later = 0;                                           ///< indices of the path
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();                    ///< of the later one, map frame
  /// Whether its heading error displaces the poses beyond. Loop closing is tuned without: it knows a pair to
  /// 0.5 deg at best, so that distant poses would seem uncertain by metres.
  bool hasLever = false;
};

/// Accumulates the errors of a path's motions. A heading error rotates the rest of the path about the place
/// where it occurred.
class PathUncertainty {
 public:
  /// @param path   map frame
  /// @param steps  of the motions that end at each pose; the first is not used
  PathUncertainty(const std::vector<mrpt::math::TPose2D>& path, const std::vector<StepVariance>& steps);

  /// Covariance of pose `to` (x, y, phi; map frame) with respect to pose `from`, along the shorter of the
  /// path and the path with a short cut through one of the known pairs. Constant time per pair.
  Eigen::Matrix3d between(size_t from, size_t to, const std::vector<KnownPair>& known = {}) const;
  /// The same for a path whose errors are distributed over its loops: where a known pair closes a loop, the
  /// mean, weighted by information, of the way through the loop and the way around it. Of several pairs, the
  /// one that leaves the least. All pairs count as with a lever, and none is in the map.
  Eigen::Matrix3d relaxed(size_t from, size_t to, const std::vector<KnownPair>& known) const;
  /// Covariance of pose `to` in the map, by the nearest pose measured there; empty without one.
  std::optional<Eigen::Matrix3d> inMap(size_t to, const std::vector<KnownPair>& known) const;

 private:
  /// Sums over the motions up to each pose.
  struct Sums {
    double position = 0, heading = 0;
    Eigen::Vector2d moment = Eigen::Vector2d::Zero();        ///< heading x place
    Eigen::Matrix2d secondMoment = Eigen::Matrix2d::Zero();  ///< heading x place x place^T
  };
  /// Covariance at `at` by the motions between two poses.
  Eigen::Matrix3d along(size_t a, size_t b, const Eigen::Vector2d& at) const;

  std::vector<Eigen::Vector2d> places_;
  std::vector<Sums> sums_;
};

}  // namespace hybrid_slam
