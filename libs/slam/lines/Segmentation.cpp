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
  table.add("split", split, "split segments at corners (iterative end-point fit); not in the paper");
  table.add("split_distance", splitDistance, 0.001, 10, "m",
            "distance from the segment's chord that makes a point a corner");
  table.add("min_points", minPoints, 2, 10000, "minimum number of points for a line");
  table.add("min_length", minLength, 0, 100, "m",
            "minimum length of a line; shorter ones have uncertain directions");
}

// Sec. III-B, step 1, without the split at corners, which the paper does not have.
SegmentedScan::SegmentedScan(const LaserScan& scan, const SegmentationOptions& options)
    : minPoints_(options.minPoints) {
  points_.reserve(scan.beams.size());
  const Beam* previous = nullptr;  // the preceding beam, if valid
  for (const Beam& beam : scan.beams) {
    if (!beam.valid) {
      previous = nullptr;
      continue;
    }
    const TPoint2D point(beam.range * std::cos(beam.angle), beam.range * std::sin(beam.angle));
    const bool joined =
        previous && std::hypot(point.x - points_.back().x, point.y - points_.back().y) <=
                        options.gapAbsolute + options.gapRelative * std::min(beam.range, previous->range);
    if (!joined) starts_.push_back(points_.size());
    points_.push_back(point);
    previous = &beam;
  }
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
  const double chord = std::hypot(b.x - a.x, b.y - a.y);
  const TPoint2D* corner = nullptr;
  double farthest = options.splitDistance;
  for (const TPoint2D& p : run) {
    // A closed run has no chord: use the point farthest from its start.
    const double distance = chord > 0
                                ? std::abs((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) / chord
                                : std::hypot(p.x - a.x, p.y - a.y);
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
