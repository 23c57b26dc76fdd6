#include "grid/ScanMatcher.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

#include "grid/CubicSpline.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

/// m and its gradient (per cell) at a place given in cells.
struct MapSample {
  double m = 0, dx = 0, dy = 0;
};

MapSample sampleMap(TileReader& cells, const std::array<float, 256>& occupied, double x, double y) {
  // Cell (i, j) has its centre at (i + 1/2, j + 1/2).
  const double cx = x - 0.5, cy = y - 0.5;
  const int i = static_cast<int>(std::floor(cx)), j = static_cast<int>(std::floor(cy));
  const SplineWeights wx(cx - i), wy(cy - j);
  MapSample sample;
  for (int row = 0; row < 4; ++row) {
    double value = 0, slope = 0;
    for (int column = 0; column < 4; ++column) {
      const auto m =
          static_cast<double>(occupied[static_cast<size_t>(cells.at(i - 1 + column, j - 1 + row) + 128)]);
      const auto c = static_cast<size_t>(column);
      value += wx.value[c] * m;
      slope += wx.slope[c] * m;
    }
    const auto r = static_cast<size_t>(row);
    sample.m += wy.value[r] * value;
    sample.dx += wy.value[r] * slope;
    sample.dy += wy.slope[r] * value;
  }
  return sample;
}

/// Calls visit(x, y, sample) with the end of each beam, in cells, and the map there.
template <class Visit>
void forEachEnd(const ScanBeams& scan, const TPose2D& pose, const OccupancyGrid& grid,
                const std::array<float, 256>& occupied, const Visit& visit) {
  const GridPose frame(pose, scan, grid.resolution());
  TileReader cells(grid.tiles());
  for (const auto& ray : scan.rays) {
    const double range = ray.range / grid.resolution();
    const double x = frame.originX + range * frame.dirX(ray), y = frame.originY + range * frame.dirY(ray);
    visit(x, y, sampleMap(cells, occupied, x, y));
  }
}

TPose2D moved(const TPose2D& pose, const Eigen::Vector3d& step) {
  return {pose.x + step.x(), pose.y + step.y(), mrpt::math::wrapToPi(pose.phi + step.z())};
}

}  // namespace

void ScanMatcherOptions::describe(OptionTable& t) {
  t.add("sigma", sigma, 0.01, 100, "", "deviation of one beam's residual 1 - m; larger trusts a match less");
  t.add("beam_step", beamStep, 1, 100, "matches every n-th beam");
  t.add("iterations", iterations, 1, 1000, "at most so many steps of a climb");
}

LogDensity gaussianLogDensity(const TPose2D& pose, const TPose2D& mean, const Eigen::Matrix3d& information) {
  const Eigen::Vector3d off(pose.x - mean.x, pose.y - mean.y, mrpt::math::wrapToPi(pose.phi - mean.phi));
  LogDensity density;
  density.gradient = -information * off;
  density.value = 0.5 * off.dot(density.gradient);
  density.information = information;
  return density;
}

ScanMatcher::ScanMatcher(const ScanMatcherOptions& options) : options_(options) {
  for (int value = -128; value < 128; ++value) {
    const double p = 1 / (1 + std::exp(-OccupancyGrid::kLogOddsScale * value));
    occupied_[static_cast<size_t>(value + 128)] = static_cast<float>(std::max(0.0, 2 * p - 1));
  }
}

LogDensity ScanMatcher::logLikelihood(const ScanBeams& scan, const TPose2D& pose,
                                      const OccupancyGrid& grid) const {
  const double perCell = 1 / grid.resolution();
  const double robotX = pose.x * perCell, robotY = pose.y * perCell;
  LogDensity density;
  forEachEnd(scan, pose, grid, occupied_, [&](double x, double y, const MapSample& sample) {
    const double residual = 1 - sample.m;
    density.value -= residual * residual;
    if (sample.dx == 0 && sample.dy == 0) return;
    // Turning the robot moves the end of the beam at a right angle to its arm.
    const Eigen::Vector3d slope(sample.dx * perCell, sample.dy * perCell,
                                -sample.dx * (y - robotY) + sample.dy * (x - robotX));
    density.gradient += residual * slope;
    density.information.noalias() += slope * slope.transpose();
  });
  const double weight = 1 / (options_.sigma * options_.sigma);
  density.value *= 0.5 * weight;
  density.gradient *= weight;
  density.information *= weight;
  return density;
}

double ScanMatcher::logLikelihoodValue(const ScanBeams& scan, const TPose2D& pose,
                                       const OccupancyGrid& grid) const {
  double sum = 0;
  forEachEnd(scan, pose, grid, occupied_,
             [&](double, double, const MapSample& sample) { sum += (1 - sample.m) * (1 - sample.m); });
  return -0.5 * sum / (options_.sigma * options_.sigma);
}

Eigen::Matrix3d ScanMatcher::curvature(const ScanBeams& scan, const TPose2D& pose,
                                       const OccupancyGrid& grid) const {
  const Eigen::Vector3d reach(1.5 * grid.resolution(), 1.5 * grid.resolution(), 0.75 * M_PI / 180);
  Eigen::Matrix3d bend;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d step = reach[k] * Eigen::Vector3d::Unit(k);
    bend.col(k) = (logLikelihood(scan, moved(pose, -step), grid).gradient -
                   logLikelihood(scan, moved(pose, step), grid).gradient) /
                  (2 * reach[k]);
  }
  // What bends upwards holds no information.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes((bend + bend.transpose()) / 2);
  return axes.eigenvectors() * axes.eigenvalues().cwiseMax(0).asDiagonal() * axes.eigenvectors().transpose();
}

ScanMatch ScanMatcher::match(const ScanBeams& scan, const TPose2D& start, const OccupancyGrid& grid,
                             const Prior& prior) const {
  constexpr double kSmallStep = 1e-4;  // m or rad
  const auto posterior = [&](const TPose2D& at) {
    LogDensity density = logLikelihood(scan, at, grid);
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
    const TPose2D next = moved(pose, step);
    const LogDensity there = posterior(next);
    if (there.value > here.value) {
      pose = next, here = there;
      damping = std::max(damping * 0.3, 1e-6);
    } else {
      damping = std::max(damping * 10, 1e-2);
    }
    if (step.cwiseAbs().maxCoeff() < kSmallStep) break;
  }
  ScanMatch match;
  match.pose = pose;
  match.logPosterior = here.value;
  match.information = curvature(scan, match.pose, grid) + prior(match.pose).information;
  forEachEnd(scan, match.pose, grid, occupied_,
             [&](double, double, const MapSample& sample) { match.fit += sample.m; });
  if (!scan.rays.empty()) match.fit /= static_cast<double>(scan.rays.size());
  return match;
}

}  // namespace hybrid_slam
