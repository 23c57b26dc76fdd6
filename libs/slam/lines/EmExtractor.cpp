/// @file EmExtractor.cpp
/// @brief Expectation maximisation of one line among outliers, after V. Nguyen et al. 2007: the E step gives
/// each point its probability to lie on the line, the M step fits the line to the points weighted by it.
#include <cmath>

#include "slam/lines/SequentialExtraction.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPoint2D;

constexpr int kTrials = 20;          // random first lines
constexpr int kMostSteps = 20;       // of EM, from each
constexpr double kConverged = 1e-3;  // points: change of the sum of the weights

/// Computes each point's probability of lying on the line, 1/2 at the distance `near` (2 sigma of the line).
/// @return their sum
double weigh(PointRange points, const FittedLine& line, double near, std::vector<double>& weights) {
  const double c = std::cos(line.theta), s = std::sin(line.theta), outlier = std::exp(-2.0);
  double sum = 0;
  weights.clear();
  for (const TPoint2D& p : points) {
    const double d = (p.x * c + p.y * s - line.rho) / near;
    const double density = std::abs(d) < 3 ? std::exp(-2 * d * d) : 0;
    weights.push_back(density / (density + outlier));
    sum += weights.back();
  }
  return sum;
}

std::optional<FittedLine> findByExpectation(PointRange points, double near, RandomStream& random) {
  std::optional<FittedLine> best;
  double most = 0;
  std::vector<double> weights;
  for (int trial = 0; trial < kTrials; ++trial) {
    auto line = randomLine(points, random);
    if (!line) continue;
    double sum = weigh(points, *line, near, weights);
    for (int step = 0; step < kMostSteps && sum > 0; ++step) {
      const double before = sum;
      line = fitOrthogonal(points, weights).value_or(*line);
      sum = weigh(points, *line, near, weights);
      if (std::abs(sum - before) < kConverged) break;
    }
    if (sum <= most) continue;
    best = line;
    most = sum;
  }
  return best;
}

std::vector<LineSegment> extractByExpectation(const LaserScan& scan, const LineExtractionOptions& options) {
  return extractSequentially(scan, options, findByExpectation);
}

}  // namespace

const LineExtractor kEmExtractor{
    "em", "the line of the largest likelihood by expectation maximisation, repeatedly", extractByExpectation};

}  // namespace hybrid_slam
