/// @file SplitExtractor.cpp
/// @brief The paper's line detection: segmentation at gaps, and, beyond the paper, at corners.
#include "slam/lines/LineExtractor.h"

namespace hybrid_slam {
namespace {

std::vector<LineSegment> extractBySplitting(const LaserScan& scan, const LineExtractionOptions& options) {
  const SegmentedScan segmented(scan, options.segmentation);
  std::vector<PointRange> pieces = segmented.runs();
  if (options.segmentation.split) {
    std::vector<PointRange> straight;
    for (const PointRange& run : pieces) splitAtCorners(run, options.segmentation, straight);
    pieces = std::move(straight);
  }
  return linesOf(pieces, scan, options);
}

}  // namespace

const LineExtractor kSplitExtractor{"split", "the paper's, and segments split at corners",
                                    extractBySplitting};

}  // namespace hybrid_slam
