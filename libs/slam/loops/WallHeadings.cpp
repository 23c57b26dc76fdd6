#include "slam/loops/WallHeadings.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

#include "base/Degree.h"
#include "slam/lines/WallDirections.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

constexpr double kMaxWallAngle = 3 * kDegree;  // off the direction of the others
constexpr double kLeastWallNoise = 0.1 * kDegree;
constexpr double kWallSigmas = 2;       // times the noise: neighbouring scans show the same walls
constexpr double kWallStretch = 40;     // m of path: most of it shows other walls than the stretch before
constexpr double kMostVariation = 1.5;  // times the expected one; 0.3-0.8 in buildings of one direction

using Errors = std::vector<std::optional<double>>;  // of headings, by the walls; rad

/// The standard deviation of a heading by the walls. Walls and motions measure the same rotations between
/// neighbours: their difference is the noise.
std::optional<double> deviationOf(const Errors& errors) {
  double squares = 0, count = 0;
  for (size_t i = 1; i < errors.size(); ++i)
    if (errors[i - 1] && errors[i]) squares += mrpt::square(*errors[i] - *errors[i - 1]), ++count;
  if (count == 0) return std::nullopt;
  return kWallSigmas * std::max(kLeastWallNoise, std::sqrt(squares / count));
}

/// Whether the mean errors of successive stretches differ by no more than their standard errors explain. The
/// drift of a path between two stretches is small. One wrong turn is not: the largest difference is left out.
bool shareOneDirection(const Errors& errors, const std::vector<double>& distances, double sigma) {
  std::vector<double> squares;  // of the differences, normalised
  double lastMean = 0, lastCount = 0;
  for (size_t i = 0; i < errors.size();) {
    const double end = distances[i] + kWallStretch;
    double sum = 0, count = 0;
    for (; i < errors.size() && distances[i] < end; ++i)
      if (errors[i]) sum += *errors[i], ++count;
    if (count == 0) continue;
    const double mean = sum / count;
    if (lastCount > 0)
      squares.push_back(mrpt::square((mean - lastMean) / sigma) / (1 / count + 1 / lastCount));
    lastMean = mean, lastCount = count;
  }
  if (squares.size() < 2) return true;
  double total = -*std::max_element(squares.begin(), squares.end());
  for (const double square : squares) total += square;
  return total < mrpt::square(kMostVariation) * static_cast<double>(squares.size() - 1);
}

}  // namespace

std::optional<double> wallDirection(const std::vector<LineSegment>& lines) {
  double length = 0;
  for (const LineSegment& line : lines) length += line.length;
  constexpr double kLeastLength = 3;  // m
  if (length < kLeastLength) return std::nullopt;
  return directionModuloRightAngle(lines);
}

std::vector<PoseEdge> wallHeadings(const std::vector<TPose2D>& poses, const std::vector<double>& distances,
                                   const std::vector<std::optional<double>>& walls, double direction) {
  Errors errors(poses.size());
  for (size_t i = 0; i < poses.size(); ++i) {
    if (!walls[i]) continue;
    const double error = wrapToRightAngle(poses[i].phi + *walls[i] - direction);
    if (std::abs(error) < kMaxWallAngle) errors[i] = error;
  }
  const std::optional<double> sigma = deviationOf(errors);
  if (!sigma || !shareOneDirection(errors, distances, *sigma)) return {};
  const Eigen::Matrix3d information = Eigen::Vector3d(0, 0, 1 / (*sigma * *sigma)).asDiagonal();
  std::vector<PoseEdge> edges;
  for (size_t i = 1; i < errors.size(); ++i) {
    if (!errors[i]) continue;
    TPose2D relative = poses[i] - poses[0];
    relative.phi = mrpt::math::wrapToPi(relative.phi - *errors[i]);
    edges.push_back({0, i, relative, information});
  }
  return edges;
}

}  // namespace hybrid_slam
