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
constexpr size_t kLanes = 16;                      // sums in two SIMD registers
constexpr double kStepAngle = mrpt::DEG2RAD(1.0);  // rad
constexpr size_t kMostBeams = 120;                 // at most 257, so that sums fit into 16 bits

/// max(0, 2 p - 1) in steps of 1/255, indexed by a cell's value as an unsigned byte.
const std::array<uint8_t, 256>& occupied() {
  static const auto table = [] {
    std::array<uint8_t, 256> values;
    for (int value = -128; value < 128; ++value) {
      const double p = OccupancyGrid::probabilityOf(value);
      values[static_cast<uint8_t>(value)] = static_cast<uint8_t>(std::lround(255 * std::max(0.0, 2 * p - 1)));
    }
    return values;
  }();
  return table;
}

/// The occupied() of a rectangle of cells: the maximum over each cell and its neighbours. Every kStep-th cell
/// of a row is stored side by side, so that their scores are summed kLanes at a time.
class WidenedMap {
 public:
  WidenedMap(const OccupancyGrid& grid, const CellBox& box)
      : min_(box.min),
        width_(static_cast<size_t>((box.max.x - box.min.x) / kStep + 1)),
        cells_(static_cast<size_t>(box.max.y - box.min.y + 1) * kStep * width_ + kLanes) {
    std::array<std::vector<uint8_t>, 3> rows;  // widened in x: those below, at and above y
    TileReader reader(grid.tiles());
    for (int y = min_.y - 1; y <= box.max.y + 1; ++y) {
      std::rotate(rows.begin(), rows.begin() + 1, rows.end());
      rows[2] = widenedRow(reader, y);
      if (y <= min_.y) continue;
      for (size_t phase = 0; phase < kStep; ++phase) {
        uint8_t* const cells = &cells_[(static_cast<size_t>(y - 1 - min_.y) * kStep + phase) * width_];
        for (size_t i = 0; i < width_; ++i) {
          const size_t x = i * kStep + phase;
          cells[i] = std::max(std::max(rows[0][x], rows[1][x]), rows[2][x]);
        }
      }
    }
  }
  /// Cell (x, y); the next ones are kStep cells apart.
  const uint8_t* cell(int x, int y) const {
    const auto column = static_cast<size_t>(x - min_.x), row = static_cast<size_t>(y - min_.y);
    return &cells_[(row * kStep + column % kStep) * width_ + column / kStep];
  }

 private:
  std::vector<uint8_t> widenedRow(TileReader& reader, int y) const {
    const size_t length = width_ * kStep;
    std::vector<uint8_t> own(length + 2);  // with a neighbour at each end
    for (int x = min_.x - 1, next; x <= min_.x + static_cast<int>(length); x = next) {
      next = (x | (Tile::kSize - 1)) + 1;
      const Tile* const tile = reader.tile(x >> Tile::kBits, y >> Tile::kBits);
      if (!tile) continue;
      const int8_t* const cell = &tile->cells()[Tile::index(x, y)];
      uint8_t* const to = &own[static_cast<size_t>(x - min_.x + 1)];
      const auto count =
          std::min(static_cast<size_t>(next - x), own.size() - static_cast<size_t>(to - own.data()));
      for (size_t i = 0; i < count; ++i) to[i] = occupied()[static_cast<uint8_t>(cell[i])];
    }
    std::vector<uint8_t> widened(length);
    for (size_t i = 0; i < length; ++i) widened[i] = std::max(std::max(own[i], own[i + 1]), own[i + 2]);
    return widened;
  }

  CellIndex min_;
  size_t width_;
  std::vector<uint8_t> cells_;  ///< row by row, in each row one phase (x modulo kStep) after the other
};

/// sums[i] += cells[i], i < count; count is a multiple of kLanes.
void add(uint16_t* sums, const uint8_t* cells, size_t count) {
  for (size_t block = 0; block < count; block += kLanes)
    for (size_t i = block; i < block + kLanes; ++i) sums[i] = static_cast<uint16_t>(sums[i] + cells[i]);
}

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

  const size_t stride = (static_cast<size_t>(side) + kLanes - 1) / kLanes * kLanes;  // sums of a row
  std::vector<uint16_t> scores(static_cast<size_t>(angles * side) * stride);
  const auto score = [&](int k, int j, int i) -> uint16_t& {
    return scores[static_cast<size_t>(k * side + j) * stride + static_cast<size_t>(i)];
  };
  for (int k = 0; k < angles; ++k)
    for (const CellIndex& end : ends[static_cast<size_t>(k)])
      for (int j = 0; j < side; ++j)
        add(&score(k, j, 0), map.cell(end.x - reach, end.y + (j - n) * kStep), stride);

  struct Place {
    int score;
    TPose2D pose;
  };
  std::vector<Place> places;
  for (int k = 0; k < angles; ++k)
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) {
        const int own = score(k, j, i);
        bool isTop = own > (i > 0 ? score(k, j, i - 1) : 0);  // of most poses no more is looked at
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
