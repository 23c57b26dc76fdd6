#include "slam/grid/ScanLikelihood.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "slam/grid/RaySamples.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

/// m and its gradient (per cell) at a position in cells.
struct MapSample {
  double m = 0, dx = 0, dy = 0;
};

/// m of a cell, indexed by its value as an unsigned byte.
const std::array<float, 256>& occupancyOfValues() {
  static const auto table = [] {
    std::array<float, 256> values;
    for (int value = -128; value < 128; ++value) {
      const double p = OccupancyGrid::probabilityOf(value);
      values[static_cast<uint8_t>(value)] = static_cast<float>(std::max(0.0, 2 * p - 1));
    }
    return values;
  }();
  return table;
}

}  // namespace

ScanLikelihood::ScanLikelihood(const ScanBeams& scan, const OccupancyGrid& grid, double sigma)
    : scan_(scan),
      resolution_(grid.resolution()),
      perCell_(1 / resolution_),
      weight_(1 / (sigma * sigma)),
      cells_(grid.tiles()),
      patches_(scan.rays.size()) {}

inline const ScanLikelihood::Patch& ScanLikelihood::patchAt(size_t beam, int x, int y) {
  Patch& patch = patches_[beam];
  if (patch.x != x || patch.y != y || !patch.isRead) {
    patch.x = x, patch.y = y;
    read(patch);
  }
  return patch;
}

void ScanLikelihood::read(Patch& patch) {
  constexpr int kLastInside = Tile::kSize - 4;
  const int x = patch.x, y = patch.y;
  const int inX = x & (Tile::kSize - 1), inY = y & (Tile::kSize - 1);
  patch.isRead = true;
  patch.isEmpty = true;
  int8_t copied[16];
  const int8_t* first = copied;
  size_t stride = 4;
  if (inX <= kLastInside && inY <= kLastInside) {  // all in one tile
    const Tile* const tile = cells_.tile(x >> Tile::kBits, y >> Tile::kBits);
    if (!tile) return;
    first = &tile->cells()[Tile::index(x, y)];
    stride = Tile::kSize;
  } else {
    for (int begin = 0, end; begin < 4; begin = end) {  // the columns of one tile, then those of the next
      end = std::min(4, ((x + begin) | (Tile::kSize - 1)) + 1 - x);
      for (int row = 0; row < 4; ++row) {
        const Tile* const tile = cells_.tile((x + begin) >> Tile::kBits, (y + row) >> Tile::kBits);
        for (int column = begin; column < end; ++column)
          copied[4 * row + column] = tile ? tile->cells()[Tile::index(x + column, y + row)] : int8_t{0};
      }
    }
  }
  // Free and unknown cells have m = 0: test whether any byte is positive, four at a time.
  uint32_t positive = 0;
  for (size_t row = 0; row < 4; ++row) {
    uint32_t four;
    std::memcpy(&four, first + row * stride, 4);
    positive |= four & ~(((four & 0x80808080u) >> 7) * 255);
  }
  if (positive == 0) return;
  patch.isEmpty = false;
  const auto at = [m = &occupancyOfValues()](int8_t cell) { return (*m)[static_cast<uint8_t>(cell)]; };
  for (size_t row = 0; row < 4; ++row) {
    const int8_t* const cell = first + row * stride;
    patch.m[row] = Float4{at(cell[0]), at(cell[1]), at(cell[2]), at(cell[3])};
  }
}

/// Calls visit(x, y, sample) with each beam's end point, in cells, and the map there.
/// @tparam kWithSlope  false: m only
template <bool kWithSlope, class Visit>
void ScanLikelihood::forEachEnd(const TPose2D& pose, const Visit& visit) {
  const GridPose frame(pose, scan_, 1 / perCell_);
  for (size_t beam = 0; beam < scan_.rays.size(); ++beam) {
    const auto& ray = scan_.rays[beam];
    const double range = ray.range * perCell_;
    const auto& origin = frame.origin(ray);
    const double x = origin.x + range * frame.dirX(ray), y = origin.y + range * frame.dirY(ray);
    // Cell (i, j) has its centre at (i + 1/2, j + 1/2).
    const double cx = x - 0.5, cy = y - 0.5;
    const int i = floorOf(cx), j = floorOf(cy);
    MapSample sample;
    const Patch& patch = patchAt(beam, i - 1, j - 1);
    if (!patch.isEmpty) {
      const SplineWeights wx(static_cast<float>(cx - i)), wy(static_cast<float>(cy - j));
      const auto downColumns = [&patch](const Float4& w) {
        return (w[0] * patch.m[0] + w[1] * patch.m[1]) + (w[2] * patch.m[2] + w[3] * patch.m[3]);
      };
      const Float4 columns = downColumns(wy.value);
      sample.m = sum(wx.value * columns);
      if constexpr (kWithSlope) {
        sample.dx = sum(wx.slope * columns);
        sample.dy = sum(wx.value * downColumns(wy.slope));
      }
    }
    visit(x, y, sample);
  }
}

/// Calls visit(residual, dx, dy, dphi) for each beam: its residual, and the derivatives of -residual.
template <class Visit>
void ScanLikelihood::forEachResidual(const TPose2D& pose, const Visit& visit) {
  const double robotX = pose.x * perCell_, robotY = pose.y * perCell_;
  forEachEnd<true>(pose, [&](double x, double y, const MapSample& sample) {
    // Rotation moves the end point perpendicular to the lever arm.
    visit(1 - sample.m, sample.dx * perCell_, sample.dy * perCell_,
          -sample.dx * (y - robotY) + sample.dy * (x - robotX));
  });
}

LogDensity ScanLikelihood::operator()(const TPose2D& pose) {
  double squares = 0, gx = 0, gy = 0, gphi = 0, xx = 0, xy = 0, xphi = 0, yy = 0, yphi = 0, phiphi = 0;
  forEachResidual(pose, [&](double residual, double dx, double dy, double dphi) {
    squares += residual * residual;
    gx += residual * dx, gy += residual * dy, gphi += residual * dphi;
    xx += dx * dx, xy += dx * dy, xphi += dx * dphi;
    yy += dy * dy, yphi += dy * dphi, phiphi += dphi * dphi;
  });
  LogDensity density;
  density.value = -0.5 * weight_ * squares;
  density.gradient = weight_ * Eigen::Vector3d(gx, gy, gphi);
  density.information << xx, xy, xphi, xy, yy, yphi, xphi, yphi, phiphi;
  density.information *= weight_;
  return density;
}

Eigen::Vector3d ScanLikelihood::gradient(const TPose2D& pose) {
  double gx = 0, gy = 0, gphi = 0;
  forEachResidual(pose, [&](double residual, double dx, double dy, double dphi) {
    gx += residual * dx, gy += residual * dy, gphi += residual * dphi;
  });
  return weight_ * Eigen::Vector3d(gx, gy, gphi);
}

double ScanLikelihood::value(const TPose2D& pose) {
  double sum = 0;
  forEachEnd<false>(pose,
                    [&](double, double, const MapSample& sample) { sum += (1 - sample.m) * (1 - sample.m); });
  return -0.5 * weight_ * sum;
}

double ScanLikelihood::fit(const TPose2D& pose) {
  double sum = 0;
  forEachEnd<false>(pose, [&](double, double, const MapSample& sample) { sum += sample.m; });
  return patches_.empty() ? 0 : sum / static_cast<double>(patches_.size());
}

}  // namespace hybrid_slam
