#include "slam/plan/WallLines.h"

#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/PointIndex.h"
#include "slam/plan/GridProbe.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPoint2D;

constexpr double kMostDifferent = 13.8;            // squared Mahalanobis distance
constexpr double kFarthest = 0.12;                 // m: lines further apart are two walls, however unsure
constexpr double kSteepest = mrpt::DEG2RAD(10.0);  // rad
constexpr double kDoor = 1.5;                      // m beyond each end
constexpr double kLineSigma = 0.01;                // m: error of an observation of a line

bool isOneLine(const LineEstimate& a, const LineEstimate& b, double cell) {
  const bool isOpposite = std::cos(a.angle - b.angle) < 0;
  const LineEstimate other = isOpposite ? b.reversed() : b;
  const double offset = std::abs(a.offset(other.at));
  if (std::abs(std::remainder(other.angle - a.angle, 2 * M_PI)) > kSteepest) return false;
  // Both faces of a wall of a cell are one line.
  if (offset > (isOpposite ? cell / 2 : kFarthest)) return false;
  return squaredDistance(a, other) < kMostDifferent;
}

/// Returns whether the cell of a point or one beside it is occupied.
bool isOccupied(const GridProbe& probe, const TPoint2D& p, const TPoint2D& normal) {
  for (const double side : {0.0, 1.0, -1.0})
    if (probe.at(p + normal * (side * probe.cell())) > 0) return true;
  return false;
}

/// Free minus occupied cells beside a stretch.
int freedom(const GridProbe& probe, const TPoint2D& a, const TPoint2D& b, const TPoint2D& side) {
  int sum = 0;
  for (int i = 0; i < 16; ++i) {
    const TPoint2D p = a + (b - a) * ((i + 0.5) / 16) + side * (3 * probe.cell());
    const int value = probe.at(p);
    sum += value < 0 ? 1 : value > 0 ? -1 : 0;
  }
  return sum;
}

/// Returns whether two faces are images of one: of the same side, one behind the other along half of `b`, and
/// nowhere there further apart than `farthest` (m).
bool areOneFace(const Face& a, const Face& b, double farthest) {
  if (std::cos(a.line.angle - b.line.angle) < std::cos(kSteepest)) return false;
  const double length = a.length(), start = a.line.along(b.start) - a.line.along(a.start),
               end = a.line.along(b.end) - a.line.along(a.start);
  if (std::min(end, length) - std::max(start, 0.0) < b.length() / 2) return false;
  return std::max(std::abs(a.line.offset(b.start)), std::abs(a.line.offset(b.end))) < farthest;
}

/// Returns whether a face is on a line, to within a cell; the other face of a thin wall, to within half of
/// one.
bool isOn(const LineEstimate& line, const Face& face, double cell) {
  const double farthest = std::cos(line.angle - face.line.angle) < 0 ? cell / 2 : cell;
  return std::max(std::abs(line.offset(face.start)), std::abs(line.offset(face.end))) < farthest;
}

/// Moves faces to an earlier line that has them already. Two images of one wall, some centimetres apart, may
/// be further apart than the covariances of their lines allow.
class Doubles {
 public:
  Doubles(std::vector<WallLine>& groups, double cell) : groups_(groups), cell_(cell), index_(kDoor) {}

  void join() {
    for (size_t g = 0; g < groups_.size(); ++g) {
      std::vector<Face>& faces = groups_[g].faces;
      std::vector<size_t> twins;  // groups of the same wall
      const auto moves = [&](const Face& face) {
        // What lies beside its double, such as beyond a door, is on the same line.
        const auto same = std::find_if(twins.begin(), twins.end(),
                                       [&](size_t twin) { return isOn(groups_[twin].line, face, cell_); });
        if (same == twins.end()) return false;
        groups_[*same].faces.push_back(face);
        return true;
      };
      for (const Face& face : faces)
        if (const size_t twin = twinOf(face, g); twin < g) twins.push_back(twin);
      faces.erase(std::remove_if(faces.begin(), faces.end(), moves), faces.end());
      for (const Face& face : faces) {
        index_.add(face.start, face.end, static_cast<int>(known_.size()));
        known_.push_back({g, face});
      }
    }
    groups_.erase(std::remove_if(groups_.begin(), groups_.end(),
                                 [](const WallLine& group) { return group.faces.empty(); }),
                  groups_.end());
  }

 private:
  struct Known {
    size_t group;
    Face face;
  };
  /// Returns the first group before `g` with an image of the face; `g` if there is none.
  size_t twinOf(const Face& face, size_t g) const {
    size_t twin = g;
    index_.near((face.start + face.end) * 0.5, [&](int i) {
      const Known& known = known_[static_cast<size_t>(i)];
      if (known.group < twin && areOneFace(known.face, face, cell_)) twin = known.group;
    });
    return twin;
  }

  std::vector<WallLine>& groups_;
  double cell_;
  PointIndex index_;
  std::vector<Known> known_;  ///< faces that stay
};

}  // namespace

std::vector<Face> facesOf(const DatabaseLine& line, const OccupancyGrid& grid) {
  std::vector<Face> faces;
  const GridProbe probe(grid);
  if (!(line.length > grid.resolution())) return faces;
  const TPoint2D d = (line.end - line.start) * (1 / line.length), normal(-d.y, d.x);
  const double angle = std::atan2(d.y, d.x);
  const int steps = static_cast<int>(line.length / grid.resolution());
  const int gap = 3;  // steps
  int first = -1, last = -1;
  for (int i = 0; i <= steps + gap + 1; ++i) {
    const TPoint2D p = line.start + d * (i * grid.resolution());
    if (i <= steps && isOccupied(probe, p, normal)) {
      if (first < 0) first = i;
      last = i;
    }
    if (first < 0 || i - last <= gap) continue;
    // A shorter stretch is a crossing wall.
    if (last - first >= 4) {
      Face face;
      face.start = line.start + d * (first * grid.resolution());
      face.end = line.start + d * (last * grid.resolution());
      face.line = lineThrough((line.start + line.end) * 0.5, angle, line.length,
                              kLineSigma / std::sqrt(std::min(line.count, 20) / 4.0 + 1));
      face.count = line.count;
      if (freedom(probe, face.start, face.end, normal) < freedom(probe, face.start, face.end, normal * -1)) {
        std::swap(face.start, face.end);
        face.line = face.line.reversed();
      }
      faces.push_back(face);
    }
    first = -1;
  }
  return faces;
}

std::vector<WallLine> wallLinesOf(std::vector<Face> faces, double cell) {
  // The longest first; faces with observations before those of the grid alone.
  std::stable_sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) {
    return (a.count > 0) != (b.count > 0) ? a.count > 0 : a.length() > b.length();
  });
  std::vector<WallLine> groups;
  PointIndex index(kDoor);
  std::vector<size_t> lastTried;  // per group: the face that was compared last
  for (size_t f = 0; f < faces.size(); ++f) {
    const Face& face = faces[f];
    int best = -1;
    double least = kMostDifferent;
    const auto consider = [&](int g) {
      const auto i = static_cast<size_t>(g);
      if (lastTried[i] == f) return;
      lastTried[i] = f;
      if (!isOneLine(groups[i].line, face.line, cell)) return;
      const bool isOpposite = std::cos(groups[i].line.angle - face.line.angle) < 0;
      const double distance = squaredDistance(groups[i].line, isOpposite ? face.line.reversed() : face.line);
      if (distance < least) least = distance, best = g;
    };
    for (const TPoint2D& p : {face.start, (face.start + face.end) * 0.5, face.end}) index.near(p, consider);
    if (best < 0) {
      best = static_cast<int>(groups.size());
      groups.push_back({face.line, {}});
      lastTried.push_back(f);
    } else {
      LineEstimate& line = groups[static_cast<size_t>(best)].line;
      // The stretches of a database line share its one estimate.
      const std::vector<Face>& known = groups[static_cast<size_t>(best)].faces;
      const bool isFused = face.count > 0 && std::any_of(known.begin(), known.end(), [&](const Face& other) {
                             return (other.line.at - face.line.at).norm() < 1e-9;
                           });
      if (!isFused)
        line = fused(line, std::cos(line.angle - face.line.angle) < 0 ? face.line.reversed() : face.line);
    }
    groups[static_cast<size_t>(best)].faces.push_back(face);
    index.add(face.start, face.end, best);
  }
  Doubles(groups, cell).join();
  return groups;
}

}  // namespace hybrid_slam
