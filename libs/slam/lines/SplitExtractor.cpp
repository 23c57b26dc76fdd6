/// @file SplitExtractor.cpp
/// @brief The paper's line detection: segmentation at gaps, and, beyond the paper, at corners; and the same
/// followed by merging, the split-and-merge of V. Nguyen et al. 2007.
#include <algorithm>
#include <utility>

#include "slam/lines/LineExtractor.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPoint2D;

using Points = std::vector<TPoint2D>;

/// Appends the pieces of a run between its corners.
void split(const PointRange& run, const SegmentationOptions& options, std::vector<PointRange>& pieces) {
  if (options.split)
    splitAtCorners(run, options, pieces);
  else
    pieces.push_back(run);
}

std::vector<LineSegment> extractBySplitting(const LaserScan& scan, const LineExtractionOptions& options) {
  const SegmentedScan segmented(scan, options.segmentation);
  std::vector<PointRange> pieces;
  for (const PointRange& run : segmented.runs()) split(run, options.segmentation, pieces);
  return linesOf(pieces, scan, options);
}

/// Points of a run on one line.
struct Line {
  Points points;
  const TPoint2D* end = nullptr;  ///< of its points in the run
};

/// Appends a later piece of the run to a line if one line fits the points of both and none of them is farther
/// from it than splitDistance. Of the points between the two, at most kMostMissing in a row may be farther:
/// a pillar divides a wall.
/// @return false if the two are not collinear; the line is then unchanged
bool merge(Line& line, PointRange piece, const LineExtractionOptions& options) {
  piece.first = std::max(piece.first, line.end);  // pieces that meet share the corner
  Points both = line.points;
  both.insert(both.end(), piece.begin(), piece.end());
  const auto fit = fitLine({both.data(), both.data() + both.size()}, options.fit);
  if (!fit) return false;
  const IsNear isNear(*fit, options.segmentation.splitDistance);
  if (!std::all_of(both.begin(), both.end(), isNear)) return false;
  Points between;  // on the line, but of pieces with few points
  size_t missing = 0;
  for (const TPoint2D& point : PointRange{line.end, piece.first}) {
    missing = isNear(point) ? 0 : missing + 1;
    if (missing > kMostMissing) return false;
    if (missing == 0) between.push_back(point);
  }
  Points all = line.points;
  all.insert(all.end(), between.begin(), between.end());
  all.insert(all.end(), piece.begin(), piece.end());
  if (!between.empty() && !fitLine({all.data(), all.data() + all.size()}, options.fit)) return false;
  line.points = std::move(all);
  line.end = piece.last;
  return true;
}

/// Merges the pieces of a run.
std::vector<Line> merged(const std::vector<PointRange>& pieces, const LineExtractionOptions& options) {
  constexpr size_t kMostPassed = 2;  // a noisy point may leave a piece of a few points on either side of it
  std::vector<Line> lines;
  for (const PointRange& piece : pieces) {
    const size_t least = lines.size() - std::min(lines.size(), kMostPassed + 1);
    size_t kept = lines.size();
    while (kept > least && !merge(lines[kept - 1], piece, options)) --kept;
    if (kept > least)
      lines.resize(kept);
    else
      lines.push_back({{piece.begin(), piece.end()}, piece.last});
  }
  return lines;
}

std::vector<LineSegment> extractBySplittingAndMerging(const LaserScan& scan,
                                                      const LineExtractionOptions& options) {
  const SegmentedScan segmented(scan, options.segmentation);
  std::vector<Line> lines;
  for (const PointRange& run : segmented.runs()) {
    std::vector<PointRange> pieces;
    split(run, options.segmentation, pieces);
    for (Line& line : merged(pieces, options)) lines.push_back(std::move(line));
  }
  std::vector<PointRange> pieces;
  for (const auto& [points, end] : lines) pieces.push_back({points.data(), points.data() + points.size()});
  return linesOf(pieces, scan, options);
}

}  // namespace

const LineExtractor kSplitExtractor{"split", "the paper's, and segments split at corners",
                                    extractBySplitting};

const LineExtractor kSplitMergeExtractor{"split_merge",
                                         "split, then neighbouring segments merged if one line fits both",
                                         extractBySplittingAndMerging};

}  // namespace hybrid_slam
