#include "slam/plan/WallCorners.h"

#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "base/PointIndex.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPoint2D;

constexpr double kReach = 0.3;                      // m: longest move of an end
constexpr double kLeastTurn = mrpt::DEG2RAD(20.0);  // rad: between the two walls

/// Intersection of the lines of two walls, as distances (m) along each.
struct Meeting {
  TPoint2D point;
  double alongA, alongB;
};

std::optional<Meeting> meeting(const PlanWall& a, const PlanWall& b) {
  const TPoint2D u = a.line.direction(), v = b.line.direction();
  const double sine = u.x * v.y - u.y * v.x;
  if (std::abs(sine) < std::sin(kLeastTurn)) return std::nullopt;
  const TPoint2D d = b.start - a.start;
  const double s = (d.x * v.y - d.y * v.x) / sine, t = (d.x * u.y - d.y * u.x) / sine;
  return Meeting{a.start + u * s, s, t};
}

class Corners {
 public:
  Corners(std::vector<PlanWall>& walls, const GridProbe& probe) : walls_(walls), probe_(probe) {
    for (size_t i = 0; i < walls.size(); ++i) index_.add(walls[i].start, walls[i].end, static_cast<int>(i));
  }

  void close() {
    std::vector<TPoint2D> starts, ends;
    for (size_t i = 0; i < walls_.size(); ++i) {
      starts.push_back(moved(i, true));
      ends.push_back(moved(i, false));
    }
    for (size_t i = 0; i < walls_.size(); ++i) {
      const TPoint2D d = ends[i] - starts[i], u = walls_[i].line.direction();
      if (d.x * u.x + d.y * u.y < 0.01) continue;
      walls_[i].start = starts[i];
      walls_[i].end = ends[i];
    }
  }

 private:
  /// The nearest point where an end of a wall meets another wall.
  TPoint2D moved(size_t i, bool isStart) const {
    const PlanWall& wall = walls_[i];
    const TPoint2D end = isStart ? wall.start : wall.end;
    TPoint2D best = end;
    double least = kReach;
    index_.near(end, [&](int other) {
      if (static_cast<size_t>(other) == i) return;
      const PlanWall& b = walls_[static_cast<size_t>(other)];
      const auto m = meeting(wall, b);
      if (!m) return;
      const double move = isStart ? -m->alongA : m->alongA - wall.length();  // outwards
      if (std::abs(move) >= least || -move > wall.length() / 2) return;
      // It meets the other wall at its end or between its ends.
      const double beyond = std::max(-m->alongB, m->alongB - b.length());
      if (beyond > kReach) return;
      if (move < 0 && beyond < -kReach) {
        // A wall is cut at another only where that ends: a crossing stays.
        if (-move > 2 * probe_.cell()) return;
      }
      if (move > probe_.cell() && probe_.freeShare(end, m->point) > 0.5) return;
      if (beyond > probe_.cell() && probe_.freeShare(m->alongB < 0 ? b.start : b.end, m->point) > 0.5) return;
      least = std::abs(move);
      best = m->point;
    });
    return best;
  }

  std::vector<PlanWall>& walls_;
  const GridProbe& probe_;
  PointIndex index_{kReach};
};

}  // namespace

void closeCorners(std::vector<PlanWall>& walls, const GridProbe& probe) { Corners(walls, probe).close(); }

}  // namespace hybrid_slam
