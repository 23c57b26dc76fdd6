/// @file Tile.h
/// @brief 32 x 32 cells of a grid, with flags for free squares.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace hybrid_slam {

/// Log-odds of occupancy in steps of 1/16 (MRPT's scale, sign reversed: positive is occupied), 0 = unknown.
/// Each square of 8 x 8 cells has a flag for free, so that a beam can skip free squares.
class Tile {
 public:
  static constexpr int kBits = 5, kSize = 1 << kBits;
  static constexpr int kSquareBits = 3, kSquareSize = 1 << kSquareBits;
  using Cells = std::array<int8_t, kSize * kSize>;

  /// Index of a cell in `cells`, row by row; x and y are grid coordinates.
  static size_t index(int x, int y) {
    return static_cast<size_t>(((y & (kSize - 1)) << kBits) | (x & (kSize - 1)));
  }
  const Cells& cells() const { return cells_; }
  /// Returns whether every cell of a square is known and more likely free than occupied.
  /// @param x,y  grid coordinates of the square: those of its cells divided by 8
  bool isFree(int x, int y) const { return isFree(x, y, x, y); }
  /// Returns whether the four corner squares of a rectangle of squares are all free.
  bool isFree(int x0, int y0, int x1, int y1) const {
    const int corners = 1 << squareIndex(x0, y0) | 1 << squareIndex(x1, y0) | 1 << squareIndex(x0, y1) |
                        1 << squareIndex(x1, y1);
    return (freeSquares_ & corners) == corners;
  }

  void set(int x, int y, int8_t value) {
    cells_[index(x, y)] = value;
    lookForFree(x >> kSquareBits, y >> kSquareBits);
  }
  template <class State>
  void visit(State& state) {
    state.bytes(cells_.data(), cells_.size());
    if constexpr (State::kIsReading) assign(Cells(cells_));
  }
  void assign(const Cells& cells) {
    cells_ = cells;
    for (int y = 0; y < kSize / kSquareSize; ++y)
      for (int x = 0; x < kSize / kSquareSize; ++x) lookForFree(x, y);
  }

 private:
  static int squareIndex(int x, int y) {
    constexpr int kSquares = kSize / kSquareSize;
    return (y & (kSquares - 1)) * kSquares + (x & (kSquares - 1));
  }
  void lookForFree(int x, int y) {
    uint64_t negative = ~uint64_t{0};  // sign bits of eight cells at a time
    for (int row = 0; row < kSquareSize; ++row) {
      uint64_t eight;
      std::memcpy(&eight, &cells_[index(x * kSquareSize, y * kSquareSize + row)], sizeof eight);
      negative &= eight;
    }
    const bool isFree = (negative & 0x8080808080808080u) == 0x8080808080808080u;
    const auto bit = static_cast<uint16_t>(1u << squareIndex(x, y));
    freeSquares_ = static_cast<uint16_t>(isFree ? freeSquares_ | bit : freeSquares_ & ~bit);
  }

  alignas(64) Cells cells_{};
  uint16_t freeSquares_ = 0;
};

}  // namespace hybrid_slam
