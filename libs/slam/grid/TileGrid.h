/// @file TileGrid.h
/// @brief An unbounded grid of small tiles, shared between copies and copied on write.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "slam/grid/CowPtr.h"
#include "slam/grid/Tile.h"

namespace hybrid_slam {

/// Column and row of a cell; cell (i, j) covers [i s, (i+1) s) x [j s, (j+1) s) for a cell size s.
struct CellIndex {
  int x = 0, y = 0;
  bool operator==(const CellIndex& o) const { return x == o.x && y == o.y; }
};

/// A rectangle of cells, both corners included; empty while max < min.
struct CellBox {
  CellIndex min{0, 0}, max{-1, -1};
  bool empty() const { return max.x < min.x || max.y < min.y; }
};

/// The cells of a map (see Tile) without bounds.
///
/// Particles with common ancestors share common cells, as in DP-SLAM. A grid is a window of blocks of 16 x 16
/// tiles of 32 x 32 cells. Blocks and tiles are copied on write: copying a grid costs a few pointers for any
/// map size, and the grid grows in any direction without moving cells.
class TileGrid {
 public:
  static constexpr int kBlockBits = 4, kBlockSize = 1 << kBlockBits;
  static constexpr size_t kMostBlocks = size_t{1} << 24;  ///< of the window, 256 MB of pointers

  /// The log-odds of a cell; 0 if never written.
  int8_t at(CellIndex cell) const {
    const Tile* tile = tileAt(cell.x >> Tile::kBits, cell.y >> Tile::kBits);
    return tile ? tile->cells()[Tile::index(cell.x, cell.y)] : int8_t{0};
  }
  void set(CellIndex cell, int8_t value) {
    writableTile(cell.x >> Tile::kBits, cell.y >> Tile::kBits).set(cell.x, cell.y, value);
  }

  /// The tile that holds cells [32 tx, 32 tx + 31] x [32 ty, 32 ty + 31], or null.
  const Tile* tileAt(int tx, int ty) const {
    const CowPtr<Block>* block = findBlock(tx >> kBlockBits, ty >> kBlockBits);
    return block && *block ? (*block)->tiles[inBlock(tx, ty)].get() : nullptr;
  }
  /// Returns the same tile for writing: created if missing, unshared if shared.
  /// @throws InputError if the map would be too large: 100 km x 100 km with cells of 5 cm
  Tile& writableTile(int tx, int ty);

  /// The cells of all tiles that exist.
  CellBox bounds() const;
  /// Calls visit(tx, ty, tile) for each tile that exists, in a fixed order.
  void forEachTile(const std::function<void(int, int, const Tile&)>& visit) const;

  template <class State>
  void visit(State& state) {
    state(firstX_, firstY_, columns_, rows_, blocks_);
    constexpr int kMost = 1 << 20;  // blocks, so that cells fit into an int
    const auto isNear = [](int first) { return -kMost <= first && first <= kMost; };
    state.check(isNear(firstX_) && isNear(firstY_) && columns_ >= 0 && columns_ <= kMost && rows_ >= 0 &&
                    rows_ <= kMost && blocks_.size() <= kMostBlocks &&
                    static_cast<size_t>(columns_) * static_cast<size_t>(rows_) == blocks_.size(),
                "a grid has the wrong size");
  }

 private:
  struct Block {
    std::array<CowPtr<Tile>, kBlockSize * kBlockSize> tiles;
    template <class State>
    void visit(State& state) {
      state(tiles);
    }
  };
  static size_t inBlock(int tx, int ty) {
    return static_cast<size_t>(((ty & (kBlockSize - 1)) << kBlockBits) | (tx & (kBlockSize - 1)));
  }
  const CowPtr<Block>* findBlock(int bx, int by) const {
    const int column = bx - firstX_, row = by - firstY_;
    if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return nullptr;
    return &blocks_[static_cast<size_t>(row * columns_ + column)];
  }
  void growTo(int bx, int by);

  int firstX_ = 0, firstY_ = 0, columns_ = 0, rows_ = 0;  ///< window of blocks, in block indices
  std::vector<CowPtr<Block>> blocks_;
};

/// Reads cells along a path; caches the last tile.
class TileReader {
 public:
  explicit TileReader(const TileGrid& grid) : grid_(&grid) {}
  int8_t at(int x, int y) {
    const Tile* const found = tile(x >> Tile::kBits, y >> Tile::kBits);
    return found ? found->cells()[Tile::index(x, y)] : int8_t{0};
  }
  /// The same tile as TileGrid::tileAt.
  const Tile* tile(int tx, int ty) {
    if (tx != tx_ || ty != ty_ || first_) {
      tile_ = grid_->tileAt(tx, ty);
      tx_ = tx, ty_ = ty, first_ = false;
    }
    return tile_;
  }

 private:
  const TileGrid* grid_;
  const Tile* tile_ = nullptr;
  int tx_ = 0, ty_ = 0;
  bool first_ = true;
};

}  // namespace hybrid_slam
