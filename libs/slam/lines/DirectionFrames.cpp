#include "slam/lines/DirectionFrames.h"

#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>

#include "slam/lines/LineDatabase.h"
#include "slam/lines/WallDirections.h"

namespace hybrid_slam {

namespace {
constexpr double kSigma = mrpt::DEG2RAD(0.5);  // of the walls of one frame
}

std::vector<DirectionFrame> directionFrames(const std::vector<DatabaseLine>& lines) {
  std::vector<const DatabaseLine*> sorted;
  for (const DatabaseLine& line : lines) sorted.push_back(&line);
  std::sort(sorted.begin(), sorted.end(),
            [](const DatabaseLine* a, const DatabaseLine* b) { return a->direction < b->direction; });
  const size_t count = sorted.size();
  const auto stepAfter = [&](size_t i) {  // to the next direction, across the wrap at 45 deg
    return std::abs(rightAngleDifference(sorted[(i + 1) % count]->direction, sorted[i]->direction));
  };
  // Begin after the widest gap, so that no frame lies across the end.
  size_t first = 0;
  for (size_t i = 0; i < count; ++i)
    if (stepAfter(i) > stepAfter((first + count - 1) % count)) first = (i + 1) % count;

  std::vector<DirectionFrame> frames;
  const double n = static_cast<double>(count);
  const double gain = std::log(M_PI / 2 / (kSigma * std::sqrt(2 * M_PI * std::exp(1))));
  DirectionFrame frame;
  double offsets = 0;  // evidence x direction relative to the frame's first line
  for (size_t k = 0; k < count; ++k) {
    const size_t i = (first + k) % count;
    const DatabaseLine& line = *sorted[i];
    if (frame.lines == 0) frame.direction = line.direction;
    offsets += evidence(line) * rightAngleDifference(line.direction, frame.direction);
    frame.evidence += evidence(line);
    ++frame.lines;
    if (k + 1 < count && stepAfter(i) < kSigma) continue;
    const double cost = std::log(M_PI / 2 * std::sqrt(frame.lines) / kSigma);
    if (frame.lines * (gain + std::log(frame.lines / n)) > cost && frame.evidence > 0) {
      frame.direction = wrapToRightAngle(frame.direction + offsets / frame.evidence);
      frames.push_back(frame);
    }
    frame = {}, offsets = 0;
  }
  std::stable_sort(frames.begin(), frames.end(),
                   [](const DirectionFrame& a, const DirectionFrame& b) { return a.evidence > b.evidence; });
  return frames;
}

}  // namespace hybrid_slam
