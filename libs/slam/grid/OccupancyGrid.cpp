#include "slam/grid/OccupancyGrid.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>
#include <vector>

#include "slam/grid/RaySamples.h"
#include "slam/grid/WallGaps.h"

namespace hybrid_slam {
namespace {

int logOdds(double p) { return static_cast<int>(std::lround(OccupancyGrid::valueOf(p))); }

/// Hits and number of crossing beams of one scan for each cell in the tiles in range. The memory is reused
/// between calls.
class Footprint {
 public:
  static constexpr uint8_t kHit = 255;

  Footprint(const ScanBeams& scan, const GridPose& pose, double cellSize, double wallGap)
      : counts_(buffer()) {
    const double perMetre = 1 / cellSize;
    thread_local std::vector<mrpt::math::TPoint2D> ends;  // in cells
    ends.clear();
    CellIndex low{floorOf(pose.origins[0].x), floorOf(pose.origins[0].y)};
    CellIndex high = low;
    const auto extend = [&](const mrpt::math::TPoint2D& point) {
      const CellIndex cell = cellAt(point);
      low = {std::min(low.x, cell.x), std::min(low.y, cell.y)};
      high = {std::max(high.x, cell.x), std::max(high.y, cell.y)};
    };
    for (size_t i = 1; i < scan.origins.size(); ++i) extend({pose.origins[i].x, pose.origins[i].y});
    for (const auto& ray : scan.rays) {
      const double range = ray.range * perMetre;
      const auto& origin = pose.origin(ray);
      ends.emplace_back(origin.x + range * pose.dirX(ray), origin.y + range * pose.dirY(ray));
      extend(ends.back());
    }
    // One cell more on each side: rounding may move an end point across a border.
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
    for (const auto& end : ends) hit(end);
    if (wallGap == 0) return;
    for (const size_t i : wallGaps(scan, wallGap)) hitBetween(ends[i], ends[i + 1]);
  }

  CellIndex firstTile() const { return first_; }
  CellIndex lastTile() const { return last_; }
  /// 32 counts: a row of cells of one tile.
  const uint8_t* row(int tileX, int y) const { return &counts_[index(tileX * Tile::kSize, y)]; }

 private:
  /// Counts the cells that a beam crosses; the origin is relative to the first tile. Follows the beam column
  /// by column (row by row if steep), with one or two cells in each, in fixed point and without branches that
  /// depend on the beam. Cells touched only at a corner do not count.
  /// @tparam kMayOverflow  whether a count can overflow
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
    // On a border, a beam leaves one cell and enters the other.
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
    if (kMayOverflow && count >= kHit - 1) return;  // enough to reach any floor
    count = static_cast<uint8_t>(count + crossings);
  }
  static CellIndex cellAt(const mrpt::math::TPoint2D& point) { return {floorOf(point.x), floorOf(point.y)}; }
  void hit(const mrpt::math::TPoint2D& point) {
    const CellIndex cell = cellAt(point);
    counts_[index(cell.x, cell.y)] = kHit;
  }
  /// Hits points half a cell apart.
  void hitBetween(const mrpt::math::TPoint2D& from, const mrpt::math::TPoint2D& to) {
    const mrpt::math::TPoint2D way = to - from;
    const int steps = static_cast<int>(std::ceil(2 * way.norm()));
    for (int k = 1; k < steps; ++k) hit(from + way * (static_cast<double>(k) / steps));
  }
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
      // A probability closer to 0.5 than the smallest step counts as one step.
      : hit(std::max(logOdds(o.pHit), 1)),
        miss(std::min(logOdds(o.pMiss), -1)),
        lowest(logOdds(o.pMin)),
        highest(logOdds(o.pMax)) {}
  int hit, miss, lowest, highest;
};

/// Updates a row of cells of a tile; compilers vectorise this loop.
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
  t.add("resolution", resolution, 0.01, 1, "m", "cell size; the paper uses 5 cm");
  t.add(
      "max_range", maxRange, 0.5, 200, "m",
      "range from which readings count as no returns: 20 m for an LMS-100; at most 10,000 cells (2,000 with "
      "MRPT's grid weights)");
  t.add("p_hit", pHit, 0.51, 0.99, "", "occupancy of an unknown cell after one hit");
  t.add("p_miss", pMiss, 0.01, 0.49, "",
        "occupancy of an unknown cell after one crossing beam; close to 0.5, so that the first mapping "
        "prevails");
  t.add("p_min", pMin, 0.001, 0.49, "",
        "minimum occupancy of a cell; bounded so that the map can still change");
  t.add("p_max", pMax, 0.51, 0.999, "", "maximum occupancy of a cell");
  t.add("wall_gap", wallGap, 0, 10, "m",
        "a straight wall between the returns of neighbouring beams counts as hit up to this length; 0: only "
        "the cells of the returns");
}

GridOptions hitsAlone(GridOptions options) {
  options.wallGap = 0;
  return options;
}

GridOptions decisive(GridOptions options) {
  options.pHit = 0.9;
  options.pMiss = 0.4;
  return hitsAlone(options);
}

double OccupancyGrid::occupancy(CellIndex cell) const { return probabilityOf(tiles_.at(cell)); }

mrpt::math::TPoint2D OccupancyGrid::middle() const {
  const CellBox box = tiles_.bounds();
  return {0.5 * (box.min.x + box.max.x) * resolution_, 0.5 * (box.min.y + box.max.y) * resolution_};
}

CellIndex OccupancyGrid::cellOf(double x, double y) const {
  return {static_cast<int>(std::floor(x / resolution_)), static_cast<int>(std::floor(y / resolution_))};
}

void OccupancyGrid::insert(const ScanBeams& scan, const mrpt::math::TPose2D& robot,
                           const GridOptions& options) {
  const Steps steps(options);
  const Footprint footprint(scan, GridPose(robot, scan, resolution_), resolution_, options.wallGap);
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
      // Cells at their bounds stay shared with other particles.
      if (isTouched && !(tile && cells == tile->cells())) tiles_.writableTile(tx, ty).assign(cells);
    }
}

void OccupancyGrid::limit(double pMin, double pMax) {
  const auto low = static_cast<int8_t>(logOdds(pMin)), high = static_cast<int8_t>(logOdds(pMax));
  const TileGrid before = tiles_;
  before.forEachTile([&](int tx, int ty, const Tile& tile) {
    Tile::Cells cells = tile.cells();
    for (int8_t& cell : cells) cell = std::clamp(cell, low, high);
    tiles_.writableTile(tx, ty).assign(cells);
  });
}

}  // namespace hybrid_slam
