#include "slam/plan/GridFaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "base/Segments.h"
#include "slam/plan/GridProbe.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPoint2D;

constexpr double kBend = 1;              // cells: farthest border point from its piece
constexpr double kShortestPiece = 0.12;  // m: shorter pieces are noise
constexpr double kShortestBorder = 0.4;  // m: of a whole border
constexpr double kBorderSigma = 0.01;    // m: error of a wall in the grid

// Directions counter-clockwise: a border goes along a side of an occupied cell with that cell on its right.
constexpr std::array<CellIndex, 4> kStep{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

/// A side of an occupied cell.
struct Side {
  CellIndex from;  ///< corner of cells
  int direction = 0;

  CellIndex to() const { return {from.x + kStep[direction].x, from.y + kStep[direction].y}; }
  /// Returns the cell on the right, which is occupied; the one on the left is not.
  CellIndex right() const {
    constexpr std::array<CellIndex, 4> kRight{{{0, -1}, {0, 0}, {-1, 0}, {-1, -1}}};
    return {from.x + kRight[direction].x, from.y + kRight[direction].y};
  }
  CellIndex left() const {
    const CellIndex c = right(), up = kStep[(direction + 1) % 4];
    return {c.x + up.x, c.y + up.y};
  }
  uint64_t key() const {
    return (static_cast<uint64_t>(static_cast<uint32_t>(from.x)) << 34) ^
           (static_cast<uint64_t>(static_cast<uint32_t>(from.y)) << 2) ^ static_cast<uint64_t>(direction);
  }
};

class Borders {
 public:
  explicit Borders(const OccupancyGrid& grid) : grid_(grid), probe_(grid) {}

  std::vector<Face> faces() {
    grid_.tiles().forEachTile([this](int tx, int ty, const Tile& tile) {
      for (int i = 0; i < Tile::kSize * Tile::kSize; ++i) {
        if (tile.cells()[static_cast<size_t>(i)] <= 0) continue;
        addSides(tx * Tile::kSize + i % Tile::kSize, ty * Tile::kSize + i / Tile::kSize);
      }
    });
    for (size_t i = 0; i < sides_.size(); ++i)
      if (!isUsed_[i]) follow(i);
    return std::move(faces_);
  }

 private:
  /// Returns whether a cell is occupied, or a gap of one cell between two occupied ones: far beams leave
  /// gaps.
  bool isWall(const CellIndex& c) const {
    const int value = probe_.at(c.x, c.y);
    if (value > 0) return true;
    const auto occupied = [&](int dx, int dy) { return probe_.at(c.x + dx, c.y + dy) > 0; };
    return value > -16 && ((occupied(-1, 0) && occupied(1, 0)) || (occupied(0, -1) && occupied(0, 1)) ||
                           (occupied(-1, -1) && occupied(1, 1)) || (occupied(-1, 1) && occupied(1, -1)));
  }

  void addSides(int x, int y) {
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const CellIndex cell{x + dx, y + dy};
        if ((dx != 0 || dy != 0) && (probe_.at(cell.x, cell.y) > 0 || !isWall(cell))) continue;
        addSidesOf(cell);
      }
  }

  void addSidesOf(const CellIndex& cell) {
    const std::array<Side, 4> all{{{{cell.x, cell.y + 1}, 0},
                                   {{cell.x, cell.y}, 1},
                                   {{cell.x + 1, cell.y}, 2},
                                   {{cell.x + 1, cell.y + 1}, 3}}};
    for (const Side& side : all) {
      if (isWall(side.left()) || !facesFree(side)) continue;
      if (known_.emplace(side.key(), sides_.size()).second) {
        sides_.push_back(side);
        isUsed_.push_back(false);
      }
    }
  }

  /// Returns whether there is free space within three cells in front of the wall.
  bool facesFree(const Side& side) const {
    const CellIndex up = kStep[(side.direction + 1) % 4];
    CellIndex c = side.left();
    int sum = 0;
    for (int i = 0; i < 3; ++i, c = {c.x + up.x, c.y + up.y}) {
      const int value = probe_.at(c.x, c.y);
      if (value > 0) break;
      sum += value;
    }
    return sum < 0;
  }

  /// The side after this one; at a corner where two cells touch, the border stays with its own cell.
  const size_t* next(const Side& side) const {
    for (const int turn : {3, 0, 1}) {
      const auto found = known_.find(Side{side.to(), (side.direction + turn) % 4}.key());
      if (found != known_.end()) return &found->second;
    }
    return nullptr;
  }
  const size_t* previous(const Side& side) const {
    for (const int turn : {1, 0, 3}) {
      const int direction = (side.direction + turn) % 4;
      const CellIndex step = kStep[direction];
      const auto found = known_.find(Side{{side.from.x - step.x, side.from.y - step.y}, direction}.key());
      if (found != known_.end()) return &found->second;
    }
    return nullptr;
  }

  void follow(size_t any) {
    size_t first = any;
    for (const size_t* before = previous(sides_[first]); before && *before != any && !isUsed_[*before];
         before = previous(sides_[first])) {
      isUsed_[*before] = true;  // so that a loop ends
      visited_.push_back(*before);
      first = *before;
    }
    for (const size_t i : visited_) isUsed_[i] = false;
    visited_.clear();

    chain_.clear();
    const size_t* here = &first;
    while (here && !isUsed_[*here]) {
      isUsed_[*here] = true;
      chain_.push_back(sides_[*here]);
      here = next(sides_[*here]);
    }
    if (static_cast<double>(chain_.size()) * probe_.cell() < kShortestBorder) return;
    split(0, chain_.size());
  }

  /// Middle of a side, in cells.
  TPoint2D middle(size_t i) const {
    const CellIndex a = chain_[i].from, b = chain_[i].to();
    return {(a.x + b.x) / 2.0, (a.y + b.y) / 2.0};
  }

  void split(size_t from, size_t to) {
    std::vector<std::pair<size_t, size_t>> open{{from, to}};
    while (!open.empty()) {
      const auto [first, last] = open.back();
      open.pop_back();
      const TPoint2D a = middle(first), b = middle(last - 1);
      double farthest = 0;
      size_t at = first;
      for (size_t i = first; i < last; ++i) {
        const TPoint2D p = middle(i);
        // The distance is that from the piece, not from its line: a border returns on the other side of a
        // thin wall.
        const double distance = (p - nearestOnSegment(p, a, b)).norm();
        if (distance > farthest) farthest = distance, at = i;
      }
      if (farthest > kBend && at > first && at + 1 < last) {
        open.emplace_back(at, last);
        open.emplace_back(first, at + 1);
      } else if ((b - a).norm() * probe_.cell() > kShortestPiece) {
        fit(first, last);
      }
    }
  }

  /// Orthogonal regression through the occupied cells up to two cells behind the border.
  void fit(size_t first, size_t last) {
    const size_t margin = std::min<size_t>(2, (last - first) / 6);  // the ends belong to other walls as well
    double sum = 0, sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
    const TPoint2D pivot = middle(first);
    for (size_t i = first + margin; i < last - margin; ++i) {
      CellIndex c = chain_[i].right();
      const CellIndex up = kStep[(chain_[i].direction + 1) % 4];
      for (int depth = 0; depth < 3; ++depth, c = {c.x - up.x, c.y - up.y}) {
        const double weight = probe_.at(c.x, c.y);
        if (weight <= 0) {
          if (depth > 0) break;
          continue;
        }
        const double x = c.x + 0.5 - pivot.x, y = c.y + 0.5 - pivot.y;
        sum += weight, sx += weight * x, sy += weight * y;
        sxx += weight * x * x, sxy += weight * x * y, syy += weight * y * y;
      }
    }
    if (sum <= 0) return;
    const double mx = sx / sum, my = sy / sum;
    const double vxx = sxx / sum - mx * mx, vxy = sxy / sum - mx * my, vyy = syy / sum - my * my;
    const TPoint2D chord = middle(last - 1) - pivot;
    double angle = std::atan2(2 * vxy, vxx - vyy) / 2;
    if (std::cos(angle) * chord.x + std::sin(angle) * chord.y < 0) angle += M_PI;
    // A piece about as wide as long has no direction of its own.
    const double chordAngle = std::atan2(chord.y, chord.x);
    if (std::abs(std::remainder(angle - chordAngle, 2 * M_PI)) > 0.3) angle = chordAngle;

    const double cell = probe_.cell();
    Face face;
    const double length = chord.norm() * cell;
    const double spread = std::sqrt(std::max(0.0, (vxx + vyy - std::hypot(vxx - vyy, 2 * vxy)) / 2)) * cell;
    face.line = lineThrough(TPoint2D(pivot.x + mx, pivot.y + my) * cell, std::remainder(angle, 2 * M_PI),
                            length, kBorderSigma + spread / 2);
    face.start = face.line.point(face.line.along(pivot * cell));
    face.end = face.line.point(face.line.along(middle(last - 1) * cell));
    faces_.push_back(face);
  }

  const OccupancyGrid& grid_;
  GridProbe probe_;
  std::vector<Side> sides_;
  std::vector<bool> isUsed_;
  std::unordered_map<uint64_t, size_t> known_;
  std::vector<size_t> visited_;
  std::vector<Side> chain_;
  std::vector<Face> faces_;
};

}  // namespace

std::vector<Face> facesOf(const OccupancyGrid& grid) { return Borders(grid).faces(); }

}  // namespace hybrid_slam
