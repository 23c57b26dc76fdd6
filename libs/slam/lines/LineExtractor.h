/// @file LineExtractor.h
/// @brief Line detection (Sec. III-B): segmentation, fit, Hough refinement.
#pragma once

#include <vector>

#include "slam/lines/HoughRefinement.h"
#include "slam/lines/LineFit.h"
#include "slam/lines/LineSegment.h"
#include "slam/lines/Segmentation.h"

namespace hybrid_slam {

/// Turns a scan into line segments. Stateless but for its options: one extractor serves all threads.
class LineExtractor {
 public:
  LineExtractor(const SegmentationOptions& segmentation, const LineFitOptions& fit,
                const HoughOptions& hough);

  /// The lines of at least minLength, in the robot frame, in beam order.
  std::vector<LineSegment> extract(const LaserScan& scan) const;

 private:
  SegmentationOptions segmentation_;
  LineFitOptions fit_;
  HoughOptions hough_;
};

}  // namespace hybrid_slam
