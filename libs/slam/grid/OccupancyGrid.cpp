#include "slam/grid/OccupancyGrid.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>
#include <vector>

#include "slam/grid/RaySamples.h"

namespace hybrid_slam {
namespace {

int logOdds(double p) {
  return static_cast<int>(std::lround(std::log(p / (1 - p)) / OccupancyGrid::kLogOddsScale));
}

/// What one scan says of each cell in the tiles that it may touch: hit, or how many beams crossed it. The
/// memory is kept between calls.
class Footprint {
 public:
  static constexpr uint8_t kHit = 255;

  Footprint(const ScanBeams& scan, const GridPose& pose, double cellSize) : counts_(buffer()) {
    const double perMetre = 1 / cellSize;
    thread_local std::vector<CellIndex> ends;
    ends.clear();
    CellIndex low{floorOf(pose.origins[0].x), floorOf(pose.origins[0].y)};
    CellIndex high = low;
    const auto extend = [&](const CellIndex& cell) {
      low = {std::min(low.x, cell.x), std::min(low.y, cell.y)};
      high = {std::max(high.x, cell.x), std::max(high.y, cell.y)};
    };
    for (size_t i = 1; i < scan.origins.size(); ++i)
      extend({floorOf(pose.origins[i].x), floorOf(pose.origins[i].y)});
    for (const auto& ray : scan.rays) {
      const double range = ray.range * perMetre;
      const auto& origin = pose.origin(ray);
      ends.push_back(
          {floorOf(origin.x + range * pose.dirX(ray)), floorOf(origin.y + range * pose.dirY(ray))});
      extend(ends.back());
    }
    // A cell more on each side: where a beam ends on a border, rounding may take it over.
    first_ = {(low.x - 1) >> Tile::kBits, (low.y - 1) >> Tile::kBits};
    last_ = {(high.x + 1) >> Tile::kBits, (high.y + 1) >> Tile::kBits};
    width_ = static_cast<size_t>(last_.x - first_.x + 1) * Tile::kSize;
    counts_.assign(width_ * static_cast<size_t>(last_.y - first_.y + 1) * Tile::kSize, 0);

    const double firstX = first_.x * Tile::kSize, firstY = first_.y * Tile::kSize;
    const auto crossAll = [&](auto mayOverflow) {
      for (const auto& ray : scan.rays)
        cross<mayOverflow>(pose.origin(ray).x - firstX, pose.origin(ray).y - firstY, pose.dirX(ray),
                           pose.dirY(ray), ray.range * perMetre);
    };
    scan.rays.size() < kHit ? crossAll(std::false_type()) : crossAll(std::true_type());
    for (const CellIndex& end : ends) at(end.x, end.y) = kHit;
  }

  CellIndex firstTile() const { return first_; }
  CellIndex lastTile() const { return last_; }
  /// 32 counts: a row of cells of one tile.
  const uint8_t* row(int tileX, int y) const { return &counts_[index(tileX * Tile::kSize, y)]; }

 private:
  /// Counts the cells that a beam crosses, the origin being relative to the first tile. The beam is followed
  /// from column to column (or from row to row if it is steep), in each of which it is in one cell or two:
  /// places in fixed point, and no branch that depends on the beam. A cell that is only
  /// touched, at a corner, is not crossed.
  /// @tparam kMayOverflow  whether more beams may cross a cell than a count holds
  template <bool kMayOverflow>
  void cross(double x, double y, double dirX, double dirY, double range) {
    const bool isSteep = std::abs(dirY) > std::abs(dirX);
    const double u = isSteep ? y : x, v = isSteep ? x : y;  // u: from column to column
    const double dirU = isSteep ? dirY : dirX, dirV = isSteep ? dirX : dirY;
    const auto strideU = static_cast<ptrdiff_t>(isSteep ? width_ : 1),
               strideV = static_cast<ptrdiff_t>(isSteep ? 1 : width_);
    const int firstColumn = floorOf(u), columns = std::abs(floorOf(u + range * dirU) - firstColumn);
    const double slope = dirV / std::abs(dirU);
    const int64_t step = fixedPoint(slope);
    // On a border, a beam comes from one cell and goes into the other.
    const int64_t toEntry = slope < 0 ? 1 : 0, toExit = slope > 0 ? 1 : 0;
    uint8_t* column = counts_.data() + firstColumn * strideU;
    const auto count = [&](int64_t entry, int64_t exit) {
      const int64_t first = (entry - toEntry) >> 32, second = (exit - toExit) >> 32;
      add<kMayOverflow>(column[first * strideV], 1);
      add<kMayOverflow>(column[second * strideV], first != second);
    };
    int64_t entry = fixedPoint(v),
            exit = fixedPoint(v + (dirU > 0 ? firstColumn + 1 - u : u - firstColumn) * slope);
    const ptrdiff_t toNext = dirU > 0 ? strideU : -strideU;
    for (int i = 0; i < columns; ++i, entry = exit, exit += step, column += toNext) count(entry, exit);
    count(entry, fixedPoint(v + range * dirV));
  }
  template <bool kMayOverflow>
  static void add(uint8_t& count, int crossings) {
    if (kMayOverflow && count >= kHit - 1) return;  // so many reach any floor
    count = static_cast<uint8_t>(count + crossings);
  }
  uint8_t& at(int x, int y) { return counts_[index(x, y)]; }
  size_t index(int x, int y) const {
    return static_cast<size_t>(y - first_.y * Tile::kSize) * width_ +
           static_cast<size_t>(x - first_.x * Tile::kSize);
  }
  static std::vector<uint8_t>& buffer() {
    thread_local std::vector<uint8_t> counts;
    return counts;
  }

  std::vector<uint8_t>& counts_;  ///< row by row
  CellIndex first_, last_;        ///< tiles
  size_t width_;
};

/// The update of a cell, in log-odds.
struct Steps {
  explicit Steps(const GridOptions& o)
      // A probability nearer to 0.5 than the smallest step still counts as one.
      : hit(std::max(logOdds(o.pHit), 1)),
        miss(std::min(logOdds(o.pMiss), -1)),
        lowest(logOdds(o.pMin)),
        highest(logOdds(o.pMax)) {}
  int hit, miss, lowest, highest;
};

/// A row of cells of a tile by what the scan says of them; a loop that compilers vectorise.
void update(int8_t* cells, const uint8_t* counts, const Steps& steps) {
  const auto hit = static_cast<int16_t>(steps.hit), miss = static_cast<int16_t>(steps.miss);
  const auto lowest = static_cast<int16_t>(steps.lowest), highest = static_cast<int16_t>(steps.highest);
  for (int i = 0; i < Tile::kSize; ++i) {
    const int16_t cell = cells[i], count = counts[i];
    const auto afterHit = std::min(static_cast<int16_t>(cell + hit), highest);
    const auto afterMisses = std::max(static_cast<int16_t>(cell + count * miss), std::min(cell, lowest));
    cells[i] = static_cast<int8_t>(count == Footprint::kHit ? afterHit : afterMisses);
  }
}

bool isZero(const uint8_t* counts) {
  std::array<uint64_t, Tile::kSize / 8> words;
  std::memcpy(words.data(), counts, sizeof words);
  return (words[0] | words[1] | words[2] | words[3]) == 0;
}

}  // namespace

void GridOptions::describe(OptionTable& t) {
  t.add("resolution", resolution, 0.01, 1, "m", "size of a cell; the paper's is 5 cm");
  t.add("max_range", maxRange, 0.5, 200, "m",
        "readings at or beyond it are no readings: 20 m for an LMS-100");
  t.add("p_hit", pHit, 0.51, 0.99, "", "occupancy that one hit alone means");
  t.add("p_miss", pMiss, 0.01, 0.49, "",
        "occupancy that one crossing beam alone means; near 0.5, so that what was mapped first prevails");
  t.add("p_min", pMin, 0.001, 0.49, "", "least occupancy of a cell, so that a map can change its mind");
  t.add("p_max", pMax, 0.51, 0.999, "", "greatest occupancy of a cell");
}

double OccupancyGrid::occupancy(CellIndex cell) const {
  return 1 / (1 + std::exp(-kLogOddsScale * tiles_.at(cell)));
}

CellIndex OccupancyGrid::cellOf(double x, double y) const {
  return {static_cast<int>(std::floor(x / resolution_)), static_cast<int>(std::floor(y / resolution_))};
}

void OccupancyGrid::insert(const ScanBeams& scan, const mrpt::math::TPose2D& robot,
                           const GridOptions& options) {
  const Steps steps(options);
  const Footprint footprint(scan, GridPose(robot, scan, resolution_), resolution_);
  const CellIndex first = footprint.firstTile(), last = footprint.lastTile();
  for (int ty = first.y; ty <= last.y; ++ty)
    for (int tx = first.x; tx <= last.x; ++tx) {
      const Tile* const tile = tiles_.tileAt(tx, ty);
      Tile::Cells cells = tile ? tile->cells() : Tile::Cells{};
      bool isTouched = false;
      for (int row = 0; row < Tile::kSize; ++row) {
        const uint8_t* const counts = footprint.row(tx, ty * Tile::kSize + row);
        if (isZero(counts)) continue;
        isTouched = true;
        update(&cells[Tile::index(0, row)], counts, steps);
      }
      // What has come to its bounds stays shared with other particles.
      if (isTouched && !(tile && cells == tile->cells())) tiles_.writableTile(tx, ty).assign(cells);
    }
}

}  // namespace hybrid_slam
