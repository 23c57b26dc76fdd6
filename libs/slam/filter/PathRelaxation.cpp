#include "slam/filter/PathRelaxation.h"

#include <algorithm>
#include <cmath>

#include "base/Degree.h"
#include "slam/filter/PathScans.h"
#include "slam/filter/ReturnMatches.h"
#include "slam/loops/PathCorrection.h"
#include "slam/loops/PathDrift.h"
#include "slam/loops/PoseGraph.h"
#include "slam/loops/RevisitCheck.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

constexpr double kNodeDistance = 0.5, kNodeAngle = 15 * kDegree;
constexpr double kLatest = RevisitCheck::kReturn;  // m of path: a map of the latest scans
constexpr double kLongMotion = 20;                 // m of path
constexpr double kOutlier = 9;                     // chi^2 at which a match has half its weight
// A motion jumps if it is off the odometry by more than kLeastJump. Beyond kDrifted or kTurned, no drift
// explains it: the odometry is wrong, or the robot was carried.
constexpr double kLeastJump = 0.15, kDrifted = 2, kTurned = 5 * kDegree;
constexpr double kBetter = 1.05;  // times the fit
constexpr int kSolutions = 3;

class Relaxation {
 public:
  Relaxation(const std::vector<TPose2D>& path, const std::vector<TPose2D>& odometry,
             const std::vector<Scans>& scans, const FilterConfiguration& configuration)
      : path_(path), odometry_(odometry), configuration_(configuration), scans_(path, scans, configuration) {
    for (size_t i = 0; i < std::min(path.size(), scans.size()); ++i) {
      const TPose2D since = i > 0 ? path[i] - path[nodes_.back()] : TPose2D();
      const bool isFar = since.norm() >= kNodeDistance || std::abs(since.phi) >= kNodeAngle;
      if (i > 0 && !isFar && !jumps(i) && !(i + 1 < path.size() && jumps(i + 1))) continue;
      nodes_.push_back(i);
      graph_.poses.push_back(path[i]);
    }
  }

  std::vector<TPose2D> solved() {
    const std::vector<PoseEdge> returns = returnMatches(scans_, nodes_, configuration_.filter.threads);
    if (returns.empty()) return path_;
    const std::vector<TPose2D> track = tracked();
    const auto addMotion = [&](size_t a, size_t b) {
      const size_t from = nodes_[a], to = nodes_[b];
      const Eigen::Matrix3d covariance = drift(from, to) + covarianceOf(kBestMatch);
      graph_.motions.push_back({a, b, track[to] - track[from], covariance.inverse()});
    };
    // The path's poses are matches, too. Their noise does not add up along the path, so longer motions, which
    // have it once, keep the path stiff.
    for (size_t k = 1, last = 0; k < nodes_.size(); ++k) {
      addMotion(k - 1, k);
      if (scans_.distance(nodes_[k]) < scans_.distance(nodes_[last]) + kLongMotion) continue;
      addMotion(last, k);
      last = k;
    }
    std::vector<TPose2D> poses = graph_.poses;
    for (int solution = 0; solution < kSolutions; ++solution) {
      PoseGraph graph = graph_;
      for (PoseEdge edge : returns) {
        if (solution > 0) edge.information /= 1 + chi2Of(edge, poses) / kOutlier;
        graph.motions.push_back(edge);
      }
      poses = optimized(graph).poses;
    }
    return corrected(path_, nodes_, poses);
  }

 private:
  /// Whether the path jumps against the odometry at update i, by as much as it may have drifted.
  bool jumps(size_t i) const {
    const TPose2D off = odometry_[i] - (path_[i] - path_[i - 1]);
    return off.norm() > kLeastJump && off.norm() < kDrifted && std::abs(off.phi) < kTurned;
  }

  /// The covariance of the motion from pose `from` to pose `to`. A radian of rotation counts as a metre.
  Eigen::Matrix3d drift(size_t from, size_t to) const {
    constexpr double kShortest = 0.01;  // m
    const double length =
        scans_.distance(to) - scans_.distance(from) + std::abs((path_[to] - path_[from]).phi);
    const PathDrift& perMetre = configuration_.useLines ? kDriftWithLines : kDriftWithoutLines;
    return (length + kShortest) * covarianceOf({perMetre.position, perMetre.position, perMetre.heading});
  }

  /// The path as the latest scans alone show it: each motion, uncertain by its drift, is corrected by a match
  /// to the map of the last kLatest to 2 kLatest metres. Where the path was drawn to old walls, it goes on
  /// from the new ones. Where it jumped to them, the odometry may fit better.
  std::vector<TPose2D> tracked() const {
    std::vector<TPose2D> track{path_.front()};
    OccupancyGrid map(scans_.resolution());
    std::vector<size_t> mapped{0};
    double begun = 0;
    scans_.insert(0, track[0], map);
    for (size_t i = 1; i <= nodes_.back(); ++i) {
      const ScanBeams beams = scans_.beams(i);
      ScanLikelihood likelihood = scans_.likelihood(beams, map);
      const auto match = [&](const TPose2D& at, const Eigen::Matrix3d& covariance) {
        return scans_.match(likelihood, at, at, covariance);
      };
      TPose2D pose = track.back() + (path_[i] - path_[i - 1]);
      if (const ScanMatch found = match(pose, drift(i - 1, i)); found.fit >= kLeastFit) pose = found.pose;
      if (jumps(i)) {
        const ScanMatch byOdometry = match(track.back() + odometry_[i], covarianceOf(kExpectedMatch));
        const ScanMatch byPath = match(pose, covarianceOf(kExpectedMatch));
        if (byOdometry.fit >= kLeastFit && byOdometry.fit > kBetter * byPath.fit) pose = byOdometry.pose;
      }
      track.push_back(pose);
      if (scans_.distance(i) < scans_.distance(mapped.back()) + kMapInterval) continue;
      mapped.push_back(i);
      if (scans_.distance(i) < begun + kLatest) {
        scans_.insert(i, pose, map);
        continue;
      }
      begun = scans_.distance(i);
      map = OccupancyGrid(scans_.resolution());
      for (size_t k = mapped.size(); k-- > 0 && scans_.distance(mapped[k]) > begun - kLatest;)
        scans_.insert(mapped[k], track[mapped[k]], map);
    }
    return track;
  }

  const std::vector<TPose2D>& path_;
  const std::vector<TPose2D>& odometry_;
  const FilterConfiguration& configuration_;
  PathScans scans_;
  std::vector<size_t> nodes_;  ///< indices of the path
  PoseGraph graph_;            ///< of the nodes
};

}  // namespace

std::vector<TPose2D> relaxed(const std::vector<TPose2D>& path, const std::vector<TPose2D>& odometry,
                             const std::vector<Scans>& scans, const FilterConfiguration& configuration) {
  return Relaxation(path, odometry, scans, configuration).solved();
}

}  // namespace hybrid_slam
