/// @file IncrementalExtractor.cpp
/// @brief Line tracking: points join the current line while they lie on it. V. Nguyen et al., "A comparison
/// of line extraction algorithms using 2D laser rangefinder for indoor mobile robotics", IROS 2005, Sec.
/// III-B.
#include <cmath>

#include "slam/lines/LineExtractor.h"

namespace hybrid_slam {
namespace {

double distance(const mrpt::math::TPoint2D& p, const FittedLine& line) {
  return std::abs(p.x * std::cos(line.theta) + p.y * std::sin(line.theta) - line.rho);
}

/// Appends the lines of a run: the first minPoints points start a line; the next point ends it if it is
/// farther than splitDistance from their fit, which is repeated with every point.
void track(PointRange run, const SegmentationOptions& options, std::vector<PointRange>& pieces) {
  const auto least = static_cast<size_t>(options.minPoints);
  while (run.size() >= least) {
    PointRange piece{run.first, run.first + least};
    auto line = fitOrthogonal(piece);
    if (!line || rmsDistance(piece, *line) > options.splitDistance / 2) {  // a corner: start one point later
      ++run.first;
      continue;
    }
    while (piece.last != run.last && distance(*piece.last, *line) <= options.splitDistance) {
      ++piece.last;
      if (const auto grown = fitOrthogonal(piece)) line = grown;  // none for points that are all the same
    }
    pieces.push_back(piece);
    run.first = piece.last;
  }
}

std::vector<LineSegment> extractByTracking(const LaserScan& scan, const LineExtractionOptions& options) {
  const SegmentedScan segmented(scan, options.segmentation);
  std::vector<PointRange> pieces;
  for (const PointRange& run : segmented.runs()) track(run, options.segmentation, pieces);
  return linesOf(pieces, scan, options);
}

}  // namespace

const LineExtractor kIncrementalExtractor{"incremental", "a line grows while the next point lies on it",
                                          extractByTracking};

}  // namespace hybrid_slam
