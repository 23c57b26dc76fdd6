/// @file HoughExtractor.cpp
/// @brief The Hough transform over all lines: each point votes for the lines through it. R. O. Duda and P. E.
/// Hart, "Use of the Hough transformation to detect lines and curves in pictures", Communications of the ACM
/// 15, 1972.
#include <algorithm>
#include <cmath>

#include "slam/lines/SequentialExtraction.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPoint2D;

constexpr int kDirections = 360;  // steps of 0.5 deg

std::optional<FittedLine> findByVotes(PointRange points, double near, RandomStream& /*random*/) {
  // rho is measured from the first point, so that the rows are as short as the run.
  const TPoint2D pivot = points.front();
  double reach = 0;
  for (const TPoint2D& p : points) reach = std::max(reach, std::hypot(p.x - pivot.x, p.y - pivot.y));
  const auto half = static_cast<size_t>(reach / near) + 1;
  std::vector<int> votes(2 * half + 1);
  std::optional<FittedLine> best;
  int most = 0;
  for (int i = 0; i < kDirections; ++i) {
    const double theta = i * M_PI / kDirections, c = std::cos(theta) / near, s = std::sin(theta) / near;
    std::fill(votes.begin(), votes.end(), 0);
    for (const TPoint2D& p : points) {
      const double cell = (p.x - pivot.x) * c + (p.y - pivot.y) * s + static_cast<double>(half) + 0.5;
      ++votes[static_cast<size_t>(cell)];
    }
    const auto peak = std::max_element(votes.begin(), votes.end());
    if (*peak <= most) continue;
    most = *peak;
    const double rho = near * (static_cast<double>(peak - votes.begin()) - static_cast<double>(half));
    best = FittedLine{signedDistance(pivot, -rho, theta), theta};
    normalise(best->rho, best->theta);
  }
  return best;
}

std::vector<LineSegment> extractByVotes(const LaserScan& scan, const LineExtractionOptions& options) {
  return extractSequentially(scan, options, findByVotes);
}

}  // namespace

const LineExtractor kHoughExtractor{"hough", "the line with the most votes of a Hough transform, repeatedly",
                                    extractByVotes};

}  // namespace hybrid_slam
