#include "slam/filter/ReturnMatches.h"

#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/PointIndex.h"
#include "base/PoseDistance.h"
#include "base/PoseRotation.h"
#include "slam/filter/Threads.h"
#include "slam/loops/RevisitCheck.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

constexpr double kNear = 3;   // m, between two nodes that see the same walls
constexpr double kReach = 6;  // m of path to either side of an earlier node: its map
// A match elsewhere counts if at least kAgreeing others within kStretch (m of path), and two thirds of them,
// are off the path by the same, within kSame (m).
constexpr int kAgreeing = 3;
constexpr double kStretch = 5, kSame = 0.1;
// Standard deviations in x, y (m) and heading (rad): of a match elsewhere, about the path's pose, and of a
// scan that shows nothing.
const Eigen::Vector3d kElsewhere(0.3, 0.3, mrpt::DEG2RAD(1.0)), kNothing(1, 1, 0.2);

/// The matches of a node, and how far (map axes) they are from the path's pose.
struct Found {
  std::optional<PoseEdge> near, elsewhere;
  TPose2D shiftNear, shiftElsewhere;
};

class Matching {
 public:
  Matching(const PathScans& scans, const std::vector<size_t>& nodes) : scans_(scans), nodes_(nodes) {
    for (size_t k = 0; k < nodes.size(); ++k) index_.add({pose(k).x, pose(k).y}, static_cast<int>(k));
  }

  Found found(size_t node) const {
    const auto earlier = nearestEarlier(node);
    return earlier ? matchTo(*earlier, node) : Found();
  }

  double distance(size_t node) const { return scans_.distance(nodes_[node]); }

 private:
  const TPose2D& pose(size_t node) const { return scans_.path()[nodes_[node]]; }

  /// The nearest node of an earlier visit.
  std::optional<size_t> nearestEarlier(size_t node) const {
    std::pair<double, size_t> nearest(kNear, 0);
    index_.near({pose(node).x, pose(node).y}, [&](int k) {
      const auto earlier = static_cast<size_t>(k);
      if (distance(earlier) <= distance(node) - RevisitCheck::kReturn)
        nearest = std::min(nearest, {distanceBetween(pose(earlier), pose(node)), earlier});
    });
    return nearest.first < kNear ? std::optional(nearest.second) : std::nullopt;
  }

  /// The map that the path made around an earlier node, at least kReturn before another one.
  OccupancyGrid mapAround(size_t earlier, size_t node) const {
    const double centre = distance(earlier);
    const double end = std::min(centre + kReach, distance(node) - RevisitCheck::kReturn);
    OccupancyGrid map(scans_.resolution());
    double next = centre - kReach;
    for (size_t i = scans_.firstFrom(next); scans_.distance(i) <= end; ++i) {
      if (scans_.distance(i) < next) continue;
      next = scans_.distance(i) + kMapInterval;
      scans_.insert(i, scans_.path()[i], map);
    }
    return map;
  }

  Found matchTo(size_t earlier, size_t node) const {
    const TPose2D &frame = pose(earlier), &expected = pose(node);
    const OccupancyGrid map = mapAround(earlier, node);
    const ScanBeams beams = scans_.beams(nodes_[node]);
    ScanLikelihood likelihood = scans_.likelihood(beams, map);
    const auto edge = [&](const ScanMatch& match) -> std::optional<PoseEdge> {
      if (match.fit < kLeastFit) return std::nullopt;
      const Eigen::Matrix3d information =
          scanInformation(likelihood, match.pose) + covarianceOf(kNothing).inverse();
      const Eigen::Matrix3d covariance =
          rotated(information.inverse() + covarianceOf(kBestMatch), -frame.phi);
      return PoseEdge{earlier, node, match.pose - frame, covariance.inverse()};
    };
    const ScanMatch near = scans_.match(likelihood, expected, expected, covarianceOf(kExpectedMatch));
    const auto shift = [&](const ScanMatch& match) {
      return TPose2D(match.pose.x - expected.x, match.pose.y - expected.y, 0);
    };
    Found found{edge(near), std::nullopt, shift(near), {}};
    const auto start = bestNear(likelihood, near.pose);
    if (!start) return found;
    const ScanMatch other = scans_.match(likelihood, *start, expected, covarianceOf(kElsewhere));
    const bool isElsewhere = distanceBetween(other.pose, near.pose) >= kSame;
    if (isElsewhere && likelihood.value(other.pose) > likelihood.value(near.pose)) {
      found.elsewhere = edge(other);
      found.shiftElsewhere = shift(other);
    }
    return found;
  }

  const PathScans& scans_;
  const std::vector<size_t>& nodes_;
  PointIndex index_{kNear};
};

}  // namespace

std::vector<PoseEdge> returnMatches(const PathScans& scans, const std::vector<size_t>& nodes, int threads) {
  const Matching matching(scans, nodes);
  std::vector<Found> found(nodes.size());
  tbb::task_arena arena(arenaThreads(threads));
  parallelFor(arena, 0, nodes.size(), [&](size_t node) { found[node] = matching.found(node); });
  const auto isConfirmed = [&](size_t node) {
    if (!found[node].elsewhere) return false;
    const auto agrees = [&](const auto& edge, const TPose2D& shift) {
      return edge && distanceBetween(shift, found[node].shiftElsewhere) < kSame;
    };
    int others = 0, agreeing = 0;
    size_t k = node;
    while (k > 0 && matching.distance(node) - matching.distance(k - 1) <= kStretch) --k;
    for (; k < nodes.size() && matching.distance(k) - matching.distance(node) <= kStretch; ++k) {
      if (k == node) continue;
      const Found& other = found[k];
      others += other.near || other.elsewhere;
      agreeing += agrees(other.elsewhere, other.shiftElsewhere) || agrees(other.near, other.shiftNear);
    }
    return agreeing >= kAgreeing && 3 * agreeing >= 2 * others;
  };
  std::vector<PoseEdge> edges;
  for (size_t node = 0; node < nodes.size(); ++node)
    if (const auto& edge = isConfirmed(node) ? found[node].elsewhere : found[node].near)
      edges.push_back(*edge);
  return edges;
}

}  // namespace hybrid_slam
