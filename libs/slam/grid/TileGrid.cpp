#include "slam/grid/TileGrid.h"

#include <algorithm>
#include <string>

#include "base/Errors.h"
#include "base/Memory.h"

namespace hybrid_slam {

Tile& TileGrid::writableTile(int tx, int ty) {
  constexpr size_t kBetweenChecks = 1 << 14;  // tiles: 16 MB
  static thread_local size_t written = 0;
  if (++written % kBetweenChecks == 0) expectBelowLimit();
  const int bx = tx >> kBlockBits, by = ty >> kBlockBits;
  if (!findBlock(bx, by)) growTo(bx, by);
  CowPtr<Block>& block = blocks_[static_cast<size_t>((by - firstY_) * columns_ + (bx - firstX_))];
  return block.write().tiles[inBlock(tx, ty)].write();
}

void TileGrid::growTo(int bx, int by) {
  const bool empty = blocks_.empty();
  const int firstX = empty ? bx : std::min(firstX_, bx), firstY = empty ? by : std::min(firstY_, by);
  const int endX = empty ? bx + 1 : std::max(firstX_ + columns_, bx + 1);
  const int endY = empty ? by + 1 : std::max(firstY_ + rows_, by + 1);
  const int columns = endX - firstX;
  const size_t count = static_cast<size_t>(columns) * static_cast<size_t>(endY - firstY);
  if (count > kMostBlocks)
    throw InputError("the map is too large", "poses of the robot",
                     "expected at most " + std::to_string(kMostBlocks) + " blocks of 512 x 512 cells");
  constexpr size_t kMostUnchecked = 1 << 20;  // bytes
  if (const size_t bytes = count * sizeof(CowPtr<Block>); bytes > kMostUnchecked) expectBelowLimit(bytes);
  std::vector<CowPtr<Block>> blocks(count);
  for (int row = 0; row < rows_; ++row)
    std::copy_n(blocks_.begin() + row * columns_, columns_,
                blocks.begin() + (row + firstY_ - firstY) * columns + (firstX_ - firstX));
  blocks_ = std::move(blocks);
  firstX_ = firstX, firstY_ = firstY, columns_ = columns, rows_ = endY - firstY;
}

void TileGrid::forEachTile(const std::function<void(int, int, const Tile&)>& visit) const {
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      const CowPtr<Block>& block = blocks_[static_cast<size_t>(row * columns_ + column)];
      if (!block) continue;
      for (int i = 0; i < kBlockSize * kBlockSize; ++i)
        if (const Tile* tile = block->tiles[static_cast<size_t>(i)].get())
          visit((firstX_ + column) * kBlockSize + (i & (kBlockSize - 1)),
                (firstY_ + row) * kBlockSize + (i >> kBlockBits), *tile);
    }
}

CellBox TileGrid::bounds() const {
  CellBox box;
  forEachTile([&box](int tx, int ty, const Tile&) {
    const CellIndex low{tx * Tile::kSize, ty * Tile::kSize};
    const CellIndex high{low.x + Tile::kSize - 1, low.y + Tile::kSize - 1};
    if (box.empty()) {
      box = {low, high};
    } else {
      box.min = {std::min(box.min.x, low.x), std::min(box.min.y, low.y)};
      box.max = {std::max(box.max.x, high.x), std::max(box.max.y, high.y)};
    }
  });
  return box;
}

}  // namespace hybrid_slam
