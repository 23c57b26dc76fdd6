/// @file RansacExtractor.cpp
/// @brief Random sample consensus: of many lines through two random points, the one with the most points
/// near it. M. A. Fischler and R. C. Bolles, "Random sample consensus", Communications of the ACM 24, 1981.
#include <algorithm>
#include <cmath>

#include "slam/lines/SequentialExtraction.h"

namespace hybrid_slam {
namespace {

constexpr double kMostTrials = 1000;   // as Nguyen et al. 2007
constexpr double kConfidence = 0.999;  // that one trial draws two points of the strongest line

/// Number of trials that draw two of a line's points at least once, with the confidence above.
/// @param share  share of the points on the line
double trialsFor(double share) {
  return std::min(kMostTrials, std::log(1 - kConfidence) / std::log1p(-share * share));
}

std::optional<FittedLine> findByConsensus(PointRange points, double near, RandomStream& random) {
  std::optional<FittedLine> best;
  size_t most = 0;
  double trials = kMostTrials;
  for (int trial = 0; trial < trials; ++trial) {
    const auto line = randomLine(points, random);
    if (!line) continue;
    const size_t count = countNear(points, *line, near);
    if (count <= most) continue;
    best = line;
    most = count;
    trials = trialsFor(static_cast<double>(count) / static_cast<double>(points.size()));
  }
  return best;
}

std::vector<LineSegment> extractByConsensus(const LaserScan& scan, const LineExtractionOptions& options) {
  return extractSequentially(scan, options, findByConsensus);
}

}  // namespace

const LineExtractor kRansacExtractor{
    "ransac", "the line through two random points with the most points near it, repeatedly",
    extractByConsensus};

}  // namespace hybrid_slam
