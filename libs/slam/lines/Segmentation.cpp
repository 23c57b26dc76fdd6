#include "slam/lines/Segmentation.h"

#include <algorithm>
#include <cmath>

namespace hybrid_slam {

using mrpt::math::TPoint2D;

void SegmentationOptions::describe(OptionTable& table) {
  table.add("gap_absolute", gapAbsolute, 0, 10, "m",
            "constant part of the largest gap between neighbouring points of a segment, gap_absolute + "
            "gap_relative x range");
  table.add("gap_relative", gapRelative, 0, 1, "",
            "range-dependent part of that gap (beam spacing grows with range)");
  table.add("split", split,
            "split and split_merge: split segments at corners (iterative end-point fit); not in the paper");
  table.add("split_distance", splitDistance, 0.001, 10, "m",
            "distance from the segment's chord that makes a point a corner; other methods: from the line, "
            "largest of "
            "its points (regression: not used)");
  table.add("min_points", minPoints, 2, 10000, "minimum number of points for a line");
  table.add("min_length", minLength, 0, 100, "m",
            "minimum length of a line; shorter ones have uncertain directions");
}

namespace {

constexpr double kClosedChord = 0.05;      // of the extent of a run all round, whose ends are neighbours
constexpr double kLongestClosedChord = 1;  // m

/// Returns whether the first beam is the neighbour of the last.
bool isRound(const std::vector<Beam>& beams) {
  if (beams.size() < 3) return false;
  const double span = beams.back().angle - beams.front().angle;
  return span + 1.5 * span / static_cast<double>(beams.size() - 1) >= 2 * M_PI;
}

}  // namespace

// Sec. III-B, step 1, without the split at corners, which the paper does not have.
SegmentedScan::SegmentedScan(const LaserScan& scan, const SegmentationOptions& options)
    : minPoints_(options.minPoints) {
  points_.reserve(scan.beams.size());
  const Beam* previous = nullptr;  // the preceding beam, if valid
  const auto isJoined = [&options](const Beam& a, const TPoint2D& pa, const Beam& b, const TPoint2D& pb) {
    return std::hypot(pa.x - pb.x, pa.y - pb.y) <=
           options.gapAbsolute + options.gapRelative * std::min(a.range, b.range);
  };
  for (const Beam& beam : scan.beams) {
    if (!beam.valid) {
      previous = nullptr;
      continue;
    }
    const TPoint2D point(beam.range * std::cos(beam.angle), beam.range * std::sin(beam.angle));
    if (!previous || !isJoined(beam, point, *previous, points_.back())) starts_.push_back(points_.size());
    points_.push_back(point);
    previous = &beam;
  }
  const bool isSeamWithinRun = previous && scan.beams.front().valid && isRound(scan.beams) &&
                               isJoined(scan.beams.front(), points_.front(), *previous, points_.back());
  if (isSeamWithinRun) beginAtGap();
}

void SegmentedScan::beginAtGap() {
  size_t begin = starts_.size() > 1 ? starts_[1] : 0;
  if (starts_.size() == 1) {  // without a gap: at a corner, the point farthest from the seam
    double farthest = 0;
    for (size_t i = 0; i < points_.size(); ++i) {
      const double distance = std::hypot(points_[i].x - points_[0].x, points_[i].y - points_[0].y);
      if (distance > farthest) farthest = distance, begin = i;
    }
    starts_.push_back(begin);
  }
  std::rotate(points_.begin(), points_.begin() + static_cast<std::ptrdiff_t>(begin), points_.end());
  starts_.erase(starts_.begin());
  for (size_t& start : starts_) start -= begin;
}

std::vector<PointRange> SegmentedScan::runs() const {
  std::vector<PointRange> result;
  for (size_t i = 0; i < starts_.size(); ++i) {
    const size_t end = i + 1 < starts_.size() ? starts_[i + 1] : points_.size();
    if (end - starts_[i] >= static_cast<size_t>(minPoints_))
      result.push_back({points_.data() + starts_[i], points_.data() + end});
  }
  return result;
}

void splitAtCorners(PointRange run, const SegmentationOptions& options, std::vector<PointRange>& pieces) {
  if (run.size() < static_cast<size_t>(options.minPoints)) return;
  const TPoint2D& a = run.front();
  const TPoint2D& b = run.back();
  const auto fromStart = [&a](const TPoint2D& p) { return std::hypot(p.x - a.x, p.y - a.y); };
  const double chord = fromStart(b);
  const bool isClosed = chord < kLongestClosedChord &&
                        std::any_of(run.begin(), run.end(),
                                    [&](const TPoint2D& p) { return fromStart(p) > chord / kClosedChord; });
  const TPoint2D* corner = nullptr;
  double farthest = options.splitDistance;
  for (const TPoint2D& p : run) {
    // A closed run has no chord to measure from: use the point farthest from its start.
    const double distance =
        isClosed ? fromStart(p) : std::abs((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) / chord;
    if (distance > farthest) {
      farthest = distance;
      corner = &p;
    }
  }
  if (!corner) {
    pieces.push_back(run);
    return;
  }
  splitAtCorners({run.first, corner + 1}, options, pieces);
  splitAtCorners({corner, run.last}, options, pieces);
}

}  // namespace hybrid_slam
