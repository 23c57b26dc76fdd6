#include "slam/grid/CorrelativeSearch.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

constexpr int kStep = 2;                           // cells
constexpr double kStepAngle = mrpt::DEG2RAD(1.0);  // rad
constexpr size_t kMostBeams = 120;

/// A rectangle of cells with max(0, 2 p - 1) in steps of 1/255: the maximum over each cell and its
/// neighbours.
class WidenedMap {
 public:
  WidenedMap(const OccupancyGrid& grid, const CellBox& box)
      : minX_(box.min.x - 1),
        minY_(box.min.y - 1),
        width_(box.max.x - box.min.x + 3),
        height_(box.max.y - box.min.y + 3),
        cells_(static_cast<size_t>(width_) * static_cast<size_t>(height_)) {
    std::array<uint8_t, 256> occupied;
    for (int value = -128; value < 128; ++value) {
      const double p = 1 / (1 + std::exp(-OccupancyGrid::kLogOddsScale * value));
      occupied[static_cast<size_t>(value + 128)] =
          static_cast<uint8_t>(std::lround(255 * std::max(0.0, 2 * p - 1)));
    }
    TileReader reader(grid.tiles());
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x)
        at(x, y) = occupied[static_cast<size_t>(reader.at(minX_ + x, minY_ + y) + 128)];
    widen(1, width_, width_, height_);
    widen(width_, height_, 1, width_);
  }
  /// Value of a cell inside the box.
  const uint8_t* cell(int x, int y) const {
    return &cells_[static_cast<size_t>(y - minY_) * static_cast<size_t>(width_) +
                   static_cast<size_t>(x - minX_)];
  }

 private:
  uint8_t& at(int x, int y) {
    return cells_[static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x)];
  }
  /// Running maximum of three along `lines` lines of `length` cells; cells are `stride` apart, lines `next`
  /// apart.
  void widen(int stride, int length, int next, int lines) {
    for (int line = 0; line < lines; ++line) {
      uint8_t* cell = &cells_[static_cast<size_t>(line) * static_cast<size_t>(next)];
      uint8_t before = 0;
      for (int i = 0; i < length; ++i, cell += stride) {
        const uint8_t own = *cell, after = i + 1 < length ? cell[stride] : uint8_t{0};
        *cell = std::max({before, own, after});
        before = own;
      }
    }
  }

  int minX_, minY_, width_, height_;
  std::vector<uint8_t> cells_;
};

}  // namespace

std::vector<TPose2D> correlativeSearch(const ScanBeams& scan, const TPose2D& centre,
                                       const OccupancyGrid& grid, const SearchWindow& window, size_t count) {
  const size_t every = (scan.rays.size() + kMostBeams - 1) / kMostBeams;
  const int n = static_cast<int>(std::ceil(window.distance / (kStep * grid.resolution())));
  const int a = static_cast<int>(std::ceil(window.angle / kStepAngle));
  const int side = 2 * n + 1, angles = 2 * a + 1;

  // Beam end points for each heading, relative to the centre.
  std::vector<std::vector<CellIndex>> ends(static_cast<size_t>(angles));
  CellBox box{{std::numeric_limits<int>::max(), std::numeric_limits<int>::max()},
              {std::numeric_limits<int>::min(), std::numeric_limits<int>::min()}};
  for (int k = 0; k < angles; ++k) {
    const GridPose frame({centre.x, centre.y, centre.phi + (k - a) * kStepAngle}, scan, grid.resolution());
    for (size_t i = 0; i < scan.rays.size(); i += every) {
      const ScanBeams::Ray& ray = scan.rays[i];
      const double range = ray.range / grid.resolution();
      const CellIndex end{static_cast<int>(std::floor(frame.origin(ray).x + range * frame.dirX(ray))),
                          static_cast<int>(std::floor(frame.origin(ray).y + range * frame.dirY(ray)))};
      ends[static_cast<size_t>(k)].push_back(end);
      box.min = {std::min(box.min.x, end.x), std::min(box.min.y, end.y)};
      box.max = {std::max(box.max.x, end.x), std::max(box.max.y, end.y)};
    }
  }
  if (box.empty()) return {};
  const int reach = n * kStep;
  const WidenedMap map(grid,
                       {{box.min.x - reach, box.min.y - reach}, {box.max.x + reach, box.max.y + reach}});

  std::vector<uint32_t> scores(static_cast<size_t>(angles * side * side));
  const auto score = [&](int k, int j, int i) -> uint32_t& {
    return scores[static_cast<size_t>((k * side + j) * side + i)];
  };
  for (int k = 0; k < angles; ++k)
    for (const CellIndex& end : ends[static_cast<size_t>(k)])
      for (int j = 0; j < side; ++j) {
        const uint8_t* row = map.cell(end.x - reach, end.y + (j - n) * kStep);
        uint32_t* sums = &score(k, j, 0);
        for (int i = 0; i < side; ++i) sums[i] += row[i * kStep];
      }

  struct Place {
    uint32_t score;
    TPose2D pose;
  };
  std::vector<Place> places;
  for (int k = 0; k < angles; ++k)
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) {
        const uint32_t own = score(k, j, i);
        bool isTop = own > 0;
        for (int dk = -1; dk <= 1 && isTop; ++dk)
          for (int dj = -1; dj <= 1 && isTop; ++dj)
            for (int di = -1; di <= 1 && isTop; ++di) {
              const int kk = k + dk, jj = j + dj, ii = i + di;
              if (kk < 0 || jj < 0 || ii < 0 || kk >= angles || jj >= side || ii >= side) continue;
              // Of equal neighbours, keep the first.
              const bool isBefore = dk < 0 || (dk == 0 && (dj < 0 || (dj == 0 && di < 0)));
              isTop = isBefore ? own > score(kk, jj, ii) : own >= score(kk, jj, ii);
            }
        if (isTop)
          places.push_back({own,
                            {centre.x + (i - n) * kStep * grid.resolution(),
                             centre.y + (j - n) * kStep * grid.resolution(),
                             mrpt::math::wrapToPi(centre.phi + (k - a) * kStepAngle)}});
      }
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& x, const Place& y) { return x.score > y.score; });
  std::vector<TPose2D> poses;
  for (size_t i = 0; i < std::min(count, places.size()); ++i) poses.push_back(places[i].pose);
  return poses;
}

}  // namespace hybrid_slam
