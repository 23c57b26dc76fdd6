#include "grid/ScanMatcher.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "grid/CubicSpline.h"
#include "grid/RayTraversal.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

/// m and its gradient (per cell) at a place given in cells.
struct MapSample {
  double m = 0, dx = 0, dy = 0;
};

/// m of the 4 x 4 cells from (x, y) on, row by row. @return false if all are 0, and then leaves `m` alone
inline bool readPatch(TileReader& cells, const std::array<double, 256>& occupied, int x, int y,
                      std::array<double, 16>& m) {
  constexpr int kLastInside = Tile::kSize - 4;
  const int inX = x & (Tile::kSize - 1), inY = y & (Tile::kSize - 1);
  int8_t copied[16];
  const int8_t* first = copied;
  size_t stride = 4;
  if (inX <= kLastInside && inY <= kLastInside) {  // all in one tile
    const Tile* const tile = cells.tile(x >> Tile::kBits, y >> Tile::kBits);
    if (!tile) return false;
    first = &tile->cells()[Tile::index(x, y)];
    stride = Tile::kSize;
  } else {
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column) copied[4 * row + column] = cells.at(x + column, y + row);
  }
  // Free and unknown cells have m = 0: whether any byte is positive, four at a time.
  uint32_t positive = 0;
  for (size_t row = 0; row < 4; ++row) {
    uint32_t four;
    std::memcpy(&four, first + row * stride, 4);
    positive |= four & ~(((four & 0x80808080u) >> 7) * 255);
  }
  if (positive == 0) return false;
  for (size_t row = 0; row < 4; ++row) {
    const int8_t* const cell = first + row * stride;
    m[4 * row] = occupied[static_cast<uint8_t>(cell[0])];
    m[4 * row + 1] = occupied[static_cast<uint8_t>(cell[1])];
    m[4 * row + 2] = occupied[static_cast<uint8_t>(cell[2])];
    m[4 * row + 3] = occupied[static_cast<uint8_t>(cell[3])];
  }
  return true;
}

/// Calls visit(x, y, sample) with the end of each beam, in cells, and the map there.
/// @tparam kWithSlope  false: m alone
template <bool kWithSlope, class Visit>
void forEachEnd(const ScanBeams& scan, const TPose2D& pose, const OccupancyGrid& grid,
                const std::array<double, 256>& occupied, const Visit& visit) {
  const GridPose frame(pose, scan, grid.resolution());
  const double perCell = 1 / grid.resolution();
  TileReader cells(grid.tiles());
  std::array<double, 16> m;
  for (const auto& ray : scan.rays) {
    const double range = ray.range * perCell;
    const double x = frame.originX + range * frame.dirX(ray), y = frame.originY + range * frame.dirY(ray);
    // Cell (i, j) has its centre at (i + 1/2, j + 1/2).
    const double cx = x - 0.5, cy = y - 0.5;
    const int i = floorOf(cx), j = floorOf(cy);
    MapSample sample;
    if (readPatch(cells, occupied, i - 1, j - 1, m)) {
      const SplineWeights wx(cx - i), wy(cy - j);
      // Down the columns first: four independent sums, which compilers put side by side.
      std::array<double, 4> value{}, slope{};
      for (size_t row = 0; row < 4; ++row)
        for (size_t column = 0; column < 4; ++column) {
          value[column] += wy.value[row] * m[4 * row + column];
          if constexpr (kWithSlope) slope[column] += wy.slope[row] * m[4 * row + column];
        }
      for (size_t column = 0; column < 4; ++column) {
        sample.m += wx.value[column] * value[column];
        if constexpr (kWithSlope) {
          sample.dx += wx.slope[column] * value[column];
          sample.dy += wx.value[column] * slope[column];
        }
      }
    }
    visit(x, y, sample);
  }
}

TPose2D moved(const TPose2D& pose, const Eigen::Vector3d& step) {
  return {pose.x + step.x(), pose.y + step.y(), mrpt::math::wrapToPi(pose.phi + step.z())};
}

}  // namespace

void ScanMatcherOptions::describe(OptionTable& t) {
  t.add("sigma", sigma, 0.01, 100, "", "deviation of one beam's residual 1 - m; larger trusts a match less");
  t.add("beams", beams, 0, 10000, "matches about so many beams of a scan, evenly spread; 0: all");
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
    occupied_[static_cast<uint8_t>(value)] = std::max(0.0, 2 * p - 1);
  }
}

LogDensity ScanMatcher::logLikelihood(const ScanBeams& scan, const TPose2D& pose,
                                      const OccupancyGrid& grid) const {
  const double perCell = 1 / grid.resolution();
  const double robotX = pose.x * perCell, robotY = pose.y * perCell;
  double squares = 0, gx = 0, gy = 0, gphi = 0, xx = 0, xy = 0, xphi = 0, yy = 0, yphi = 0, phiphi = 0;
  forEachEnd<true>(scan, pose, grid, occupied_, [&](double x, double y, const MapSample& sample) {
    const double residual = 1 - sample.m;
    squares += residual * residual;
    // Turning the robot moves the end of the beam at a right angle to its arm.
    const double dx = sample.dx * perCell, dy = sample.dy * perCell;
    const double dphi = -sample.dx * (y - robotY) + sample.dy * (x - robotX);
    gx += residual * dx, gy += residual * dy, gphi += residual * dphi;
    xx += dx * dx, xy += dx * dy, xphi += dx * dphi;
    yy += dy * dy, yphi += dy * dphi, phiphi += dphi * dphi;
  });
  const double weight = 1 / (options_.sigma * options_.sigma);
  LogDensity density;
  density.value = -0.5 * weight * squares;
  density.gradient = weight * Eigen::Vector3d(gx, gy, gphi);
  density.information << xx, xy, xphi, xy, yy, yphi, xphi, yphi, phiphi;
  density.information *= weight;
  return density;
}

double ScanMatcher::logLikelihoodValue(const ScanBeams& scan, const TPose2D& pose,
                                       const OccupancyGrid& grid) const {
  double sum = 0;
  forEachEnd<false>(scan, pose, grid, occupied_,
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
  forEachEnd<false>(scan, match.pose, grid, occupied_,
                    [&](double, double, const MapSample& sample) { match.fit += sample.m; });
  if (!scan.rays.empty()) match.fit /= static_cast<double>(scan.rays.size());
  return match;
}

}  // namespace hybrid_slam
