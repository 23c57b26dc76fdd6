#include "grid/OccupancyGrid.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "grid/RaySamples.h"

namespace hybrid_slam {
namespace {

int logOdds(double p) {
  return static_cast<int>(std::lround(std::log(p / (1 - p)) / OccupancyGrid::kLogOddsScale));
}

/// What one scan says of each cell in the tiles that it may touch: hit, or how many beams crossed it. A beam
/// crosses a cell in each column, or in each row if it is the steeper, as in MRPT's grid. The memory is kept
/// between calls.
class Footprint {
 public:
  static constexpr uint8_t kHit = 255;

  Footprint(const ScanBeams& scan, const GridPose& pose, double cellSize) : counts_(buffer()) {
    std::vector<CellIndex> ends;
    ends.reserve(scan.rays.size());
    CellIndex low{floorOf(pose.originX), floorOf(pose.originY)};
    CellIndex high = low;
    for (const auto& ray : scan.rays) {
      const double range = ray.range / cellSize;
      const CellIndex end{floorOf(pose.originX + range * pose.dirX(ray)),
                          floorOf(pose.originY + range * pose.dirY(ray))};
      low = {std::min(low.x, end.x), std::min(low.y, end.y)};
      high = {std::max(high.x, end.x), std::max(high.y, end.y)};
      ends.push_back(end);
    }
    // A cell more on each side: where a beam ends on a border, rounding may take it over.
    first_ = {(low.x - 1) >> Tile::kBits, (low.y - 1) >> Tile::kBits};
    last_ = {(high.x + 1) >> Tile::kBits, (high.y + 1) >> Tile::kBits};
    width_ = static_cast<size_t>(last_.x - first_.x + 1) * Tile::kSize;
    counts_.assign(width_ * static_cast<size_t>(last_.y - first_.y + 1) * Tile::kSize, 0);

    for (const CellIndex& end : ends) at(end.x, end.y) = kHit;
    uint8_t* const counts = counts_.data();  // and the width: a write of bytes might change what members say
    const size_t width = width_;
    // In the frame of the first tile, where no place is negative.
    const double originX = pose.originX - first_.x * Tile::kSize,
                 originY = pose.originY - first_.y * Tile::kSize;
    for (const auto& ray : scan.rays) {
      const double dirX = pose.dirX(ray), dirY = pose.dirY(ray);
      const double perCell = std::max(std::abs(dirX), std::abs(dirY));
      const int last = static_cast<int>(ray.range / cellSize * perCell);
      RaySamples place(originX, originY, dirX / perCell, dirY / perCell);
      for (int i = 0; i <= last; ++i, place.advance()) {
        uint8_t& count =
            counts[static_cast<size_t>(place.cellY()) * width + static_cast<size_t>(place.cellX())];
        count = static_cast<uint8_t>(count + (count < kHit - 1));  // so many reach any floor
      }
    }
  }

  CellIndex firstTile() const { return first_; }
  CellIndex lastTile() const { return last_; }
  /// 32 counts: a row of cells of one tile.
  const uint8_t* row(int tileX, int y) const { return &counts_[index(tileX << Tile::kBits, y)]; }

 private:
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
        const uint8_t* const counts = footprint.row(tx, (ty << Tile::kBits) + row);
        if (isZero(counts)) continue;
        isTouched = true;
        update(&cells[Tile::index(0, row)], counts, steps);
      }
      // What has come to its bounds stays shared with other particles.
      if (isTouched && !(tile && cells == tile->cells())) tiles_.writableTile(tx, ty).assign(cells);
    }
}

}  // namespace hybrid_slam
