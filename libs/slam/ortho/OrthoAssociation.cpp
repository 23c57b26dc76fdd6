#include "slam/ortho/OrthoAssociation.h"

#include <algorithm>
#include <cmath>

namespace hybrid_slam {

std::vector<SeenOrthoLine> orthogonalLines(const std::vector<LineSegment>& seen, double heading,
                                           double maxAngle) {
  std::vector<SeenOrthoLine> all;
  for (const LineSegment& line : seen) {
    const double quarters = std::round((line.theta + heading) / (M_PI / 2));
    const double deviation = line.theta + heading - quarters * M_PI / 2;
    if (std::abs(deviation) > maxAngle) continue;
    const int side = ((static_cast<int>(quarters) % 4) + 4) % 4;
    all.push_back({middle(line), deviation, line.length, side});
  }
  return all;
}

PlacedLine::PlacedLine(const SeenOrthoLine& seen, const mrpt::math::TPose2D& pose) {
  const mrpt::math::TPoint2D at = pose.composePoint(seen.middle);
  const bool isAcrossX = seen.side % 2 == 0;
  offset = isAcrossX ? at.x : at.y;
  if (isAcrossX)
    byPose << 1, 0, pose.y - at.y;
  else
    byPose << 0, 1, at.x - pose.x;
  const double along = isAcrossX ? at.y : at.x;
  low = along - seen.length / 2;
  high = along + seen.length / 2;
}

OrthoState::Measurement measurementOf(const PlacedLine& placed, size_t line, const OrthoState& state,
                                      double variance) {
  OrthoState::Measurement difference = state.measurement(placed.offset - state.offset(line), variance);
  difference.byState.head<3>() = -placed.byPose;
  difference.byState[OrthoState::index(line)] = 1;
  return difference;
}

bool areNear(double low, double high, const OrthoLine& line, double maxGap) {
  return std::max(low, line.low) - std::min(high, line.high) <= maxGap;
}

std::optional<size_t> associate(const SeenOrthoLine& seen, const PlacedLine& placed,
                                const std::vector<OrthoLine>& lines, const OrthoState& state,
                                const OrthoOptions& options) {
  std::optional<size_t> nearest;
  double least = options.gate * options.gate;
  for (size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].side != seen.side || !areNear(placed.low, placed.high, lines[i], options.maxGap)) continue;
    const double distance =
        state.squaredDistance(measurementOf(placed, i, state, options.sigmaOffset * options.sigmaOffset));
    if (distance > least) continue;
    least = distance;
    nearest = i;
  }
  return nearest;
}

}  // namespace hybrid_slam
