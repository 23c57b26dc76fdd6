#include "study/evaluation/RevisitError.h"

#include <algorithm>
#include <cmath>
#include <nanoflann.hpp>
#include <optional>

#include "base/Errors.h"
#include "base/Segments.h"
#include "study/evaluation/Association.h"
#include "study/evaluation/StampIndex.h"

namespace hybrid_slam::evaluation {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr double kReach = 0.5;   // m; largest distance to a compared point
constexpr double kMaxGap = 0.3;  // m; between end points of neighbouring beams on one wall
constexpr double kFewest = 0.3;  // least fraction of a scan's points compared

struct PlacedScan {
  TPose2D pose;          // m, rad
  double way = 0;        // m, distance driven so far
  size_t begin, end;     // rows in PlacedPoints
  bool earlier = false;  // revisited by the current scan
};

/// The end points of all scans in the map, as a nanoflann data set.
struct PlacedPoints {
  std::vector<TPoint2D> at;    // m
  std::vector<size_t> scanOf;  // row of the scan

  size_t kdtree_get_point_count() const { return at.size(); }
  double kdtree_get_pt(size_t i, size_t dimension) const { return dimension == 0 ? at[i].x : at[i].y; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, PlacedPoints>,
                                                 PlacedPoints, 2, size_t>;

/// nanoflann result set: the nearest point within kReach that belongs to an earlier scan. nanoflann 1.7 asks
/// for DistanceType and sort() as well, 1.4 for neither.
class NearestEarlier {
 public:
  using DistanceType = double;

  NearestEarlier(const PlacedPoints& points, const std::vector<PlacedScan>& scans)
      : points_(points), scans_(scans) {}

  bool addPoint(double squaredDistance, size_t i) {
    if (squaredDistance < best_ && scans_[points_.scanOf[i]].earlier) best_ = squaredDistance, found_ = i;
    return true;
  }
  double worstDist() const { return best_; }
  bool full() const { return found_.has_value(); }
  void sort() {}
  std::optional<size_t> found() const { return found_; }

 private:
  const PlacedPoints& points_;
  const std::vector<PlacedScan>& scans_;
  double best_ = kReach * kReach;
  std::optional<size_t> found_;
};

/// Distance (m) from p to the wall seen by the earlier scan around its end point `i`.
double distanceToWall(const TPoint2D& p, const PlacedPoints& points, const PlacedScan& seen, size_t i) {
  const TPoint2D& nearest = points.at[i];
  double distance = (p - nearest).norm();
  const auto alongTo = [&](size_t neighbour) {
    const TPoint2D& other = points.at[neighbour];
    if ((other - nearest).norm() <= kMaxGap)
      distance = std::min(distance, (p - nearestOnSegment(p, nearest, other)).norm());
  };
  if (i > seen.begin) alongTo(i - 1);
  if (i + 1 < seen.end) alongTo(i + 1);
  return distance;
}

std::vector<PlacedScan> place(const files::Trajectory& trajectory,
                              const std::vector<readings::EndPoints>& scans, PlacedPoints& points) {
  StampSequence rows(trajectory, kTimeTolerance);
  std::vector<PlacedScan> placed;
  for (const readings::EndPoints& scan : scans) {
    const auto row = rows.next(scan.timestamp);
    if (!row) continue;
    PlacedScan here;
    here.pose = trajectory[*row].pose;
    if (!placed.empty())
      here.way = placed.back().way +
                 std::hypot(here.pose.x - placed.back().pose.x, here.pose.y - placed.back().pose.y);
    here.begin = points.at.size();
    for (const TPoint2D& point : scan.points) {
      points.at.push_back(here.pose.composePoint(point));
      points.scanOf.push_back(placed.size());
    }
    here.end = points.at.size();
    placed.push_back(here);
  }
  if (placed.empty()) {
    files::Trajectory times;
    for (const readings::EndPoints& scan : scans) times.push_back({scan.timestamp, {}});
    throw InputError(
        "no scan has a pose",
        "trajectory " + timeSpan(trajectory) + ", scans " + (scans.empty() ? "none" : timeSpan(times)),
        "expected poses within 0.001 s of the scans");
  }
  return placed;
}

/// Marks the scans that this scan revisits. @return whether any has end points
bool markEarlier(std::vector<PlacedScan>& scans, const PlacedScan& scan, const RevisitOptions& options) {
  bool any = false;
  for (PlacedScan& other : scans) {
    other.earlier = scan.way - other.way >= options.path &&
                    std::hypot(scan.pose.x - other.pose.x, scan.pose.y - other.pose.y) <= options.distance;
    any |= other.earlier && other.end > other.begin;
  }
  return any;
}

}  // namespace

RevisitErrors revisitErrors(const files::Trajectory& trajectory,
                            const std::vector<readings::EndPoints>& scans, const RevisitOptions& options) {
  PlacedPoints points;
  std::vector<PlacedScan> placed = place(trajectory, scans, points);
  Tree tree(2, points);
  tree.buildIndex();

  RevisitErrors result;
  result.scans = placed.size();
  std::vector<double> errors;
  for (const PlacedScan& scan : placed) {
    if (scan.begin == scan.end || !markEarlier(placed, scan, options)) continue;
    std::vector<double> distances;
    for (size_t i = scan.begin; i < scan.end; ++i) {
      const TPoint2D& p = points.at[i];
      NearestEarlier nearest(points, placed);
      tree.findNeighbors(nearest, &p.x, {});
      if (const auto found = nearest.found())
        distances.push_back(distanceToWall(p, points, placed[points.scanOf[*found]], *found));
    }
    const bool isApart =
        static_cast<double>(distances.size()) < kFewest * static_cast<double>(scan.end - scan.begin);
    result.apart += isApart;
    errors.push_back(isApart ? kReach : errorStatistics(distances).median);
  }
  result.revisits = errors.size();
  if (errors.empty()) return result;
  std::sort(errors.begin(), errors.end());
  result.p95 = errors[(95 * errors.size() + 99) / 100 - 1];
  result.error = errorStatistics(errors);
  return result;
}

}  // namespace hybrid_slam::evaluation
