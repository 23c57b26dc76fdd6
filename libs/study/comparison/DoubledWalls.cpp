#include "study/comparison/DoubledWalls.h"

#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>
#include <nanoflann.hpp>

#include "study/comparison/Statistics.h"
#include "study/evaluation/StampIndex.h"

namespace hybrid_slam::comparison {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr double kSampleStep = 0.1;                 // m, along a wall
constexpr double kNear = 0.15;                      // m, between a sample and an end point on it
constexpr double kLeastWay = 0.2;                   // m, between scans
constexpr double kLeastTurn = mrpt::DEG2RAD(10.0);  // rad
constexpr double kTimeTolerance = 0.001;            // s, from a scan to the run's pose
constexpr double kPause = 30;                       // s, between two passes
constexpr double kLargestSpread = 0.2;              // m: wider than a wall drawn once
constexpr size_t kLeastScans = 3;                   // in a pass
constexpr size_t kLeastInARow = 3;

/// The samples as a nanoflann data set.
template <class Sample>
struct SamplePoints {
  const std::vector<Sample>& samples;

  size_t kdtree_get_point_count() const { return samples.size(); }
  double kdtree_get_pt(size_t i, size_t dimension) const {
    return dimension == 0 ? samples[i].at.x : samples[i].at.y;
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

TPoint2D rotated(const TPoint2D& v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}

bool isFar(const TPose2D& from, const TPose2D& to) {
  const TPose2D motion = to - from;
  return motion.norm() >= kLeastWay || std::abs(motion.phi) >= kLeastTurn;
}

/// The images of one wall sample in a map, pass by pass.
class Images {
 public:
  void add(double timestamp, const TPoint2D& at, const TPoint2D& normal) {
    if (at_.empty() || std::abs(timestamp - last_) > kPause) begins_.push_back(at_.size());
    last_ = timestamp;
    at_.push_back(at);
    normal_ += normal;
  }
  bool empty() const { return at_.empty(); }

  /// Returns whether they are too far apart for one wall. Ignores passes with too few scans.
  bool areSpread() const {
    const TPoint2D across = normal_ * (1 / std::max(normal_.norm(), 1e-9));
    double low = INFINITY, high = -INFINITY;  // m, of the passes' medians
    for (size_t pass = 0; pass < begins_.size(); ++pass) {
      const size_t end = pass + 1 < begins_.size() ? begins_[pass + 1] : at_.size();
      if (end - begins_[pass] < kLeastScans) continue;
      std::vector<double> offsets;
      for (size_t i = begins_[pass]; i < end; ++i) {
        const TPoint2D way = at_[i] - at_[0];
        offsets.push_back(way.x * across.x + way.y * across.y);
      }
      if (interpolatedQuantile(offsets, 0.9) - interpolatedQuantile(offsets, 0.1) > kLargestSpread)
        return true;
      const double median = interpolatedQuantile(offsets, 0.5);
      low = std::min(low, median);
      high = std::max(high, median);
    }
    return high - low > kLargestSpread;
  }

 private:
  std::vector<TPoint2D> at_;    // m, in the map
  std::vector<size_t> begins_;  // of each pass
  TPoint2D normal_{0, 0};       // sum
  double last_ = 0;             // s
};

}  // namespace

WallSightings::WallSightings(const simulation::BuildingPlan& plan, const files::Trajectory& reference,
                             const std::vector<readings::EndPoints>& scans, double tolerance) {
  for (size_t w = 0; w < plan.walls().size(); ++w) {
    const simulation::Wall& wall = plan.walls()[w];
    const double pieces = std::max(1.0, std::round(wall.length() / kSampleStep));
    for (double i = 0; i < pieces; ++i) {
      const TPoint2D along = wall.pointAt((i + 1) / pieces) - wall.pointAt(i / pieces);
      samples_.push_back(
          {wall.pointAt((i + 0.5) / pieces), TPoint2D(-along.y, along.x) * (1 / along.norm()), w, {}});
    }
  }
  const SamplePoints<Sample> points{samples_};
  nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, SamplePoints<Sample>>,
                                      SamplePoints<Sample>, 2, size_t>
      tree(2, points);
  tree.buildIndex();

  const evaluation::StampIndex index(reference);
  for (const readings::EndPoints& scan : scans) {
    const auto row = index.nearest(scan.timestamp, tolerance);
    if (!row) continue;
    const TPose2D& pose = reference[*row].pose;
    if (!scans_.empty() && !isFar(scans_.back().pose, pose)) continue;
    const auto number = static_cast<uint32_t>(scans_.size());
    scans_.push_back({scan.timestamp, pose});
    for (const TPoint2D& point : scan.points) {
      const TPoint2D inPlan = pose.composePoint(point);
      size_t nearest = 0;
      double squaredDistance = 0;
      if (tree.knnSearch(&inPlan.x, 1, &nearest, &squaredDistance) == 0 || squaredDistance > kNear * kNear)
        continue;
      auto& seenBy = samples_[nearest].scans;
      if (seenBy.empty() || seenBy.back() != number) seenBy.push_back(number);
    }
  }
}

bool WallSightings::empty() const {
  return std::all_of(samples_.begin(), samples_.end(), [](const Sample& s) { return s.scans.empty(); });
}

std::optional<double> WallSightings::doubledShare(const files::Trajectory& run) const {
  const evaluation::StampIndex index(run);
  std::vector<std::optional<TPose2D>> toMap;  // plan frame to map frame, per scan
  for (const Scan& scan : scans_) {
    const auto row = index.nearest(scan.timestamp, kTimeTolerance);
    toMap.push_back(row ? std::optional(run[*row].pose + (TPose2D() - scan.pose)) : std::nullopt);
  }
  size_t shown = 0, doubled = 0, inARow = 0, wall = 0;
  const auto endRow = [&] {
    if (inARow >= kLeastInARow) doubled += inARow;
    inARow = 0;
  };
  for (const Sample& sample : samples_) {
    if (sample.wall != wall) endRow();
    wall = sample.wall;
    Images images;
    for (const uint32_t i : sample.scans)
      if (toMap[i])
        images.add(scans_[i].timestamp, toMap[i]->composePoint(sample.at),
                   rotated(sample.normal, toMap[i]->phi));
    shown += !images.empty();
    if (images.areSpread())
      ++inARow;
    else
      endRow();
  }
  endRow();
  if (shown == 0) return std::nullopt;
  return static_cast<double>(doubled) / static_cast<double>(shown);
}

}  // namespace hybrid_slam::comparison
