#include "slam/grid/ScanMatcher.h"

#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>

#include "base/PoseOffset.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;

void ScanMatcherOptions::describe(OptionTable& t) {
  t.add("sigma", sigma, 0.01, 100, "",
        "standard deviation of a beam's residual 1 - m; larger: matches are trusted less");
  t.add("beams", beams, 0, 10000, "number of beams matched, evenly over the wall directions; 0: all");
  t.add("iterations", iterations, 1, 1000, "maximum number of optimisation steps");
}

LogDensity gaussianLogDensity(const TPose2D& pose, const TPose2D& mean, const Eigen::Matrix3d& information) {
  const Eigen::Vector3d off = offsetOf(pose, mean);
  LogDensity density;
  density.gradient = -information * off;
  density.value = 0.5 * off.dot(density.gradient);
  density.information = information;
  return density;
}

Prior normalPrior(const TPose2D& expected, const Eigen::Vector3d& deviations) {
  const Eigen::Matrix3d information = deviations.cwiseAbs2().cwiseInverse().asDiagonal();
  return [expected, information](const TPose2D& pose) {
    return gaussianLogDensity(pose, expected, information);
  };
}

ScanMatcher::ScanMatcher(const ScanMatcherOptions& options) : options_(options) {}

ScanLikelihood ScanMatcher::likelihood(const ScanBeams& scan, const OccupancyGrid& grid) const {
  return ScanLikelihood(scan, grid, options_.sigma);
}

Eigen::Matrix3d scanInformation(ScanLikelihood& likelihood, const TPose2D& pose) {
  const double cells = 1.5 * likelihood.resolution();
  const Eigen::Vector3d reach(cells, cells, mrpt::DEG2RAD(0.75));
  Eigen::Matrix3d bend;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d step = reach[k] * Eigen::Vector3d::Unit(k);
    bend.col(k) = (likelihood.gradient(displaced(pose, -step)) - likelihood.gradient(displaced(pose, step))) /
                  (2 * reach[k]);
  }
  // Directions of positive curvature hold no information.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes((bend + bend.transpose()) / 2);
  return axes.eigenvectors() * axes.eigenvalues().cwiseMax(0).asDiagonal() * axes.eigenvectors().transpose();
}

ScanMatch ScanMatcher::match(const ScanBeams& scan, const TPose2D& start, const OccupancyGrid& grid,
                             const Prior& prior) const {
  ScanLikelihood on = likelihood(scan, grid);
  return match(on, start, prior);
}

ScanMatch ScanMatcher::match(ScanLikelihood& likelihood, const TPose2D& start, const Prior& prior) const {
  constexpr double kNegligibleGain = 0.01;  // of ln p: the pose is within 0.14 sigma of the maximum
  const auto posterior = [&](const TPose2D& at) {
    LogDensity density = likelihood(at);
    return density += prior(at);
  };
  TPose2D pose = start;
  LogDensity here = posterior(pose);
  double damping = 1e-3;
  for (int i = 0; i < options_.iterations; ++i) {
    Eigen::Matrix3d damped = here.information;
    damped.diagonal() *= 1 + damping;
    damped.diagonal().array() += 1e-9;
    const Eigen::Vector3d step = damped.ldlt().solve(here.gradient);
    if (0.5 * step.dot(here.gradient) < kNegligibleGain) break;
    const TPose2D next = displaced(pose, step);
    const LogDensity there = posterior(next);
    if (there.value > here.value) {
      pose = next, here = there;
      damping = std::max(damping * 0.3, 1e-6);
    } else {
      damping = std::max(damping * 10, 1e-2);
    }
  }
  ScanMatch match;
  match.pose = pose;
  match.logPosterior = here.value;
  match.fit = likelihood.fit(match.pose);
  return match;
}

std::optional<TPose2D> bestNear(ScanLikelihood& likelihood, const TPose2D& pose) {
  constexpr double kReach = 0.5;  // m
  std::optional<TPose2D> best;
  double highest = likelihood.value(pose);
  const double step = likelihood.resolution();
  for (int i = 1; i * step <= kReach; ++i)
    for (const TPose2D& side : {TPose2D(1, 0, 0), TPose2D(-1, 0, 0), TPose2D(0, 1, 0), TPose2D(0, -1, 0)}) {
      const TPose2D there = pose + TPose2D(i * step * side.x, i * step * side.y, 0);
      if (const double value = likelihood.value(there); value > highest) {
        highest = value;
        best = i > 1 ? std::optional(there) : std::nullopt;
      }
    }
  return best;
}

double degeneracy(const Eigen::Matrix3d& information) {
  Eigen::Matrix2d position = information.topLeftCorner<2, 2>();
  const Eigen::Vector2d withHeading = information.topRightCorner<2, 1>();
  if (information(2, 2) > 0) position -= withHeading * withHeading.transpose() / information(2, 2);
  const Eigen::Vector2d values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(position).eigenvalues();
  return values[1] > 0 ? std::max(values[0], 0.0) / values[1] : 0;
}

}  // namespace hybrid_slam
