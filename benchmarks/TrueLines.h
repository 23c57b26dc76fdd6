/// @file TrueLines.h
/// @brief The lines that a simulated scan shows, and how far extracted lines agree with them.
#pragma once

#include <mrpt/core/bits_math.h>
#include <mrpt/math/TPose2D.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/LaserScan.h"
#include "slam/lines/LineAssociation.h"
#include "study/simulation/BuildingPlan.h"

namespace hybrid_slam::bench {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

/// A visible piece of a straight wall, in the frame of the plan: consecutive beams that hit it, with gaps of
/// at most two other beams.
struct TrueLine {
  LineSegment segment;
  size_t beams = 0;
};

inline std::vector<TrueLine> trueLines(const simulation::BuildingPlan& plan, const LaserScan& scan,
                                       const TPose2D& robot) {
  const TPose2D sensor = robot + scan.sensorPose;
  std::vector<TrueLine> lines;
  struct Piece {
    const simulation::Wall* wall;
    size_t last, beams;
    TPoint2D start, end;
  };
  std::vector<Piece> pieces;
  for (size_t i = 0; i < scan.beams.size(); ++i) {
    const double heading = sensor.phi + scan.beams[i].angle;
    const TPoint2D direction(std::cos(heading), std::sin(heading));
    const simulation::Wall* hit = nullptr;
    double range = scan.maxRange;
    for (const simulation::Wall& wall : plan.walls()) {
      const double distance = simulation::rayDistance(wall, TPoint2D(sensor.x, sensor.y), direction);
      if (distance < range) hit = &wall, range = distance;
    }
    if (!hit || hit->isArc()) continue;
    const TPoint2D point(sensor.x + range * direction.x, sensor.y + range * direction.y);
    const auto piece = std::find_if(pieces.rbegin(), pieces.rend(),
                                    [&](const Piece& p) { return p.wall == hit && i <= p.last + 3; });
    if (piece == pieces.rend())
      pieces.push_back({hit, i, 1, point, point});
    else
      piece->last = i, piece->end = point, ++piece->beams;
  }
  for (const Piece& piece : pieces) lines.push_back({makeSegment(piece.start, piece.end), piece.beams});
  return lines;
}

/// Sums over scans, after Nguyen et al. 2007.
struct Agreement {
  size_t trueLines = 0, found = 0, wrong = 0;
  std::vector<double> angles, distances;  ///< rad, m: errors of the lines found

  /// An extracted line matches a true one within 5 deg and 0.1 m (at its middle) if they overlap by half of
  /// the shorter. Each matches at most one, the longest overlaps first. A line that matches a piece shorter
  /// than a line, or with fewer beams, counts neither as found nor as wrong.
  void add(const std::vector<LineSegment>& lines, const std::vector<TrueLine>& truth, double minLength,
           size_t minBeams) {
    constexpr double kAngle = mrpt::DEG2RAD(5.0), kDistance = 0.1, kOverlap = 0.5;
    const auto isLine = [&](const TrueLine& t) {
      return t.segment.length >= minLength && t.beams >= minBeams;
    };
    struct Match {
      size_t line, truth;
      LineDifference difference;
    };
    std::vector<Match> matches;
    for (size_t i = 0; i < lines.size(); ++i)
      for (size_t k = 0; k < truth.size(); ++k) {
        const LineDifference d = difference(lines[i], truth[k].segment);
        if (std::abs(d.theta) <= kAngle && std::abs(d.rho) <= kDistance &&
            d.overlap >= kOverlap * std::min(lines[i].length, truth[k].segment.length) && d.overlap > 0)
          matches.push_back({i, k, d});
      }
    std::sort(matches.begin(), matches.end(),
              [](const Match& a, const Match& b) { return a.difference.overlap > b.difference.overlap; });
    std::vector<bool> isUsed(lines.size()), isSeen(truth.size());
    for (const Match& m : matches) {
      if (isUsed[m.line] || isSeen[m.truth]) continue;
      isUsed[m.line] = isSeen[m.truth] = true;
      if (!isLine(truth[m.truth])) continue;
      ++found;
      angles.push_back(m.difference.theta);
      distances.push_back(m.difference.rho);
    }
    trueLines += static_cast<size_t>(std::count_if(truth.begin(), truth.end(), isLine));
    wrong += static_cast<size_t>(std::count(isUsed.begin(), isUsed.end(), false));
  }
};

}  // namespace hybrid_slam::bench
