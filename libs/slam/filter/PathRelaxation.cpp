#include "slam/filter/PathRelaxation.h"

#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/PoseDistance.h"
#include "base/PoseRotation.h"
#include "slam/filter/Threads.h"
#include "slam/grid/BeamSelection.h"
#include "slam/grid/ScanMatcher.h"
#include "slam/loops/PathCorrection.h"
#include "slam/loops/PathDrift.h"
#include "slam/loops/PoseGraph.h"
#include "slam/loops/RevisitCheck.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

constexpr double kDegree = mrpt::DEG2RAD(1.0);
constexpr double kNodeDistance = 0.5, kNodeAngle = 15 * kDegree;
constexpr double kReturn = RevisitCheck::kReturn;  // also of a map of the latest scans
constexpr double kNear = 3;                        // m, between two nodes that see the same walls
constexpr double kReach = 6;                       // m of path to either side of an earlier node: its map
constexpr double kMapInterval = 0.6;               // m of path between the scans of that map
constexpr double kMinFit = 0.1;                    // of a match; a map of one scan fits 0.04
constexpr double kOutlier = 9;                     // chi^2 at which a match has half its weight
// A motion jumps if it is off the odometry by more than kLeastJump. Beyond kDrifted or kTurned, no drift
// explains it: the odometry is wrong, or the robot was carried.
constexpr double kLeastJump = 0.15, kDrifted = 2, kTurned = 5 * kDegree;
constexpr double kBetter = 1.05;  // times the fit
constexpr int kSolutions = 3;
// Standard deviations in x, y (m) and heading (rad): of a match about the path's pose, and of a scan that
// shows all or nothing.
const Eigen::Vector3d kExpected(0.1, 0.1, kDegree), kBest(0.005, 0.005, 0.05 * kDegree), kWorst(1, 1, 0.2);

Eigen::Matrix3d covarianceOf(const Eigen::Vector3d& deviations) {
  return deviations.cwiseAbs2().asDiagonal();
}

class Relaxation {
 public:
  Relaxation(const std::vector<TPose2D>& path, const std::vector<TPose2D>& odometry,
             const std::vector<Scans>& scans, const FilterConfiguration& configuration)
      : path_(path),
        odometry_(odometry),
        scans_(scans),
        configuration_(configuration),
        matcher_(configuration.matcher),
        distances_(lengthsAlong(path)) {
    for (size_t i = 0; i < std::min(path.size(), scans.size()); ++i) {
      const TPose2D since = i > 0 ? path[i] - path[nodes_.back()] : TPose2D();
      const bool isFar = since.norm() >= kNodeDistance || std::abs(since.phi) >= kNodeAngle;
      if (i > 0 && !isFar && !jumps(i) && !(i + 1 < path.size() && jumps(i + 1))) continue;
      nodes_.push_back(i);
      graph_.poses.push_back(path[i]);
    }
  }

  std::vector<TPose2D> solved() {
    std::vector<std::optional<PoseEdge>> returns(nodes_.size());
    tbb::task_arena arena(arenaThreads(configuration_.filter.threads));
    parallelFor(arena, 0, nodes_.size(), [&](size_t node) {
      if (const auto earlier = nearestEarlier(node)) returns[node] = matchTo(*earlier, node);
    });
    if (std::none_of(returns.begin(), returns.end(), [](const auto& edge) { return edge.has_value(); }))
      return path_;
    const std::vector<TPose2D> track = tracked();
    for (size_t k = 1; k < nodes_.size(); ++k) {
      const size_t from = nodes_[k - 1], to = nodes_[k];
      graph_.motions.push_back({k - 1, k, track[to] - track[from], drift(from, to).inverse()});
    }
    std::vector<TPose2D> poses = graph_.poses;
    for (int solution = 0; solution < kSolutions; ++solution) {
      PoseGraph graph = graph_;
      for (const auto& edge : returns) {
        if (!edge) continue;
        graph.motions.push_back(*edge);
        if (solution > 0) graph.motions.back().information /= 1 + chi2Of(*edge, poses) / kOutlier;
      }
      poses = optimized(graph).poses;
    }
    return corrected(path_, nodes_, poses);
  }

 private:
  LaserScans scansOf(size_t i) const { return toLaserScans(scans_[i], configuration_.grid.maxRange); }
  void insert(size_t i, const TPose2D& pose, OccupancyGrid& map) const {
    map.insert(ScanBeams(scansOf(i)), pose, configuration_.grid);
  }

  /// Whether the path jumps against the odometry at update i, by as much as it may have drifted.
  bool jumps(size_t i) const {
    const TPose2D off = odometry_[i] - (path_[i] - path_[i - 1]);
    return off.norm() > kLeastJump && off.norm() < kDrifted && std::abs(off.phi) < kTurned;
  }

  /// The nearest node of an earlier visit.
  std::optional<size_t> nearestEarlier(size_t node) const {
    std::optional<size_t> nearest;
    double least = kNear;
    for (size_t k = 0; distances_[nodes_[k]] <= distances_[nodes_[node]] - kReturn; ++k)
      if (const double distance = distanceBetween(graph_.poses[k], graph_.poses[node]); distance < least)
        least = distance, nearest = k;
    return nearest;
  }

  /// The map that the path made around an earlier node, before the visit of another one.
  OccupancyGrid mapAround(size_t earlier, size_t node) const {
    const double centre = distances_[nodes_[earlier]];
    const double end = std::min(centre + kReach, distances_[nodes_[node]] - kReturn);
    OccupancyGrid map(configuration_.grid.resolution);
    double next = centre - kReach;
    const auto first = std::lower_bound(distances_.begin(), distances_.end(), next);
    for (auto i = static_cast<size_t>(first - distances_.begin()); distances_[i] <= end; ++i) {
      if (distances_[i] < next) continue;
      next = distances_[i] + kMapInterval;
      insert(i, path_[i], map);
    }
    return map;
  }

  /// A scan on a map.
  struct Seen {
    ScanLikelihood likelihood;
    ScanMatch match;
  };
  /// Matches scan i, expected at `pose` with this covariance.
  /// @param beams  filled; the likelihood refers to them
  Seen match(size_t i, const TPose2D& pose, const Eigen::Matrix3d& covariance, const OccupancyGrid& map,
             ScanBeams& beams) const {
    const LaserScans scans = scansOf(i);
    beams = ScanBeams(scans, BeamSelection(scans).take(configuration_.matcher.beams));
    Seen seen{matcher_.likelihood(beams, map), {}};
    const Eigen::Matrix3d information = covariance.inverse();
    seen.match = matcher_.match(seen.likelihood, pose,
                                [&](const TPose2D& at) { return gaussianLogDensity(at, pose, information); });
    return seen;
  }

  /// The pose of a node by the map of an earlier visit.
  std::optional<PoseEdge> matchTo(size_t earlier, size_t node) const {
    const TPose2D& frame = graph_.poses[earlier];
    const OccupancyGrid map = mapAround(earlier, node);
    ScanBeams beams;
    Seen seen = match(nodes_[node], graph_.poses[node], covarianceOf(kExpected), map, beams);
    if (seen.match.fit < kMinFit) return std::nullopt;
    const Eigen::Matrix3d information =
        scanInformation(seen.likelihood, seen.match.pose) + covarianceOf(kWorst).inverse();
    const Eigen::Matrix3d covariance = rotated(information.inverse() + covarianceOf(kBest), -frame.phi);
    return PoseEdge{earlier, node, seen.match.pose - frame, covariance.inverse()};
  }

  /// The covariance of the motion from pose `from` to pose `to`. A radian of rotation counts as a metre.
  Eigen::Matrix3d drift(size_t from, size_t to) const {
    constexpr double kShortest = 0.01;  // m
    const double length = distances_[to] - distances_[from] + std::abs((path_[to] - path_[from]).phi);
    const PathDrift& drift = configuration_.useLines ? kDriftWithLines : kDriftWithoutLines;
    return (length + kShortest) * covarianceOf({drift.position, drift.position, drift.heading});
  }

  /// The path as the latest scans alone show it: each motion, uncertain by its drift, is corrected by a match
  /// to the map of the last kReturn to 2 kReturn metres. Where the path was drawn to old walls, it goes on
  /// from the new ones. Where it jumped to them, the odometry may fit better.
  std::vector<TPose2D> tracked() const {
    std::vector<TPose2D> track{path_.front()};
    OccupancyGrid map(configuration_.grid.resolution);
    std::vector<size_t> mapped{0};
    double begun = 0;
    insert(0, track[0], map);
    for (size_t i = 1; i <= nodes_.back(); ++i) {
      TPose2D pose = track.back() + (path_[i] - path_[i - 1]);
      ScanBeams beams;
      const Seen seen = match(i, pose, drift(i - 1, i), map, beams);
      if (seen.match.fit >= kMinFit) pose = seen.match.pose;
      if (jumps(i)) {
        const auto matchNear = [&](const TPose2D& at) {
          return match(i, at, covarianceOf(kExpected), map, beams).match;
        };
        const ScanMatch byOdometry = matchNear(track.back() + odometry_[i]), byPath = matchNear(pose);
        if (byOdometry.fit >= kMinFit && byOdometry.fit > kBetter * byPath.fit) pose = byOdometry.pose;
      }
      track.push_back(pose);
      if (distances_[i] < distances_[mapped.back()] + kMapInterval) continue;
      mapped.push_back(i);
      if (distances_[i] < begun + kReturn) {
        insert(i, pose, map);
        continue;
      }
      begun = distances_[i];
      map = OccupancyGrid(configuration_.grid.resolution);
      for (size_t k = mapped.size(); k-- > 0 && distances_[mapped[k]] > begun - kReturn;)
        insert(mapped[k], track[mapped[k]], map);
    }
    return track;
  }

  const std::vector<TPose2D>& path_;
  const std::vector<TPose2D>& odometry_;
  const std::vector<Scans>& scans_;
  const FilterConfiguration& configuration_;
  ScanMatcher matcher_;
  std::vector<double> distances_;  ///< m, along the path
  std::vector<size_t> nodes_;      ///< indices of the path
  PoseGraph graph_;                ///< of the nodes
};

}  // namespace

std::vector<TPose2D> relaxed(const std::vector<TPose2D>& path, const std::vector<TPose2D>& odometry,
                             const std::vector<Scans>& scans, const FilterConfiguration& configuration) {
  return Relaxation(path, odometry, scans, configuration).solved();
}

}  // namespace hybrid_slam
