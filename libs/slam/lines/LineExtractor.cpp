#include "slam/lines/LineExtractor.h"

namespace hybrid_slam {

LineExtractor::LineExtractor(const SegmentationOptions& segmentation, const LineFitOptions& fit,
                             const HoughOptions& hough)
    : segmentation_(segmentation), fit_(fit), hough_(hough) {}

std::vector<LineSegment> LineExtractor::extract(const LaserScan& scan) const {
  const SegmentedScan segmented(scan, segmentation_);
  std::vector<PointRange> pieces = segmented.runs();
  if (segmentation_.split) {
    std::vector<PointRange> straight;
    for (const PointRange& run : pieces) splitAtCorners(run, segmentation_, straight);
    pieces = std::move(straight);
  }

  std::vector<LineSegment> lines;
  for (const PointRange& points : pieces) {
    auto line = fitLine(points, fit_);
    if (!line) continue;
    if (hough_.enabled) line = refineByHough(points, *line, hough_);
    const LineSegment segment = makeSegment(line->rho, line->theta, points.front(), points.back());
    if (segment.length >= segmentation_.minLength) lines.push_back(transformed(segment, scan.sensorPose));
  }
  return lines;
}

}  // namespace hybrid_slam
