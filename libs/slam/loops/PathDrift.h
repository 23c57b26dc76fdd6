/// @file PathDrift.h
/// @brief How far a mapped path drifts before it returns.
#pragma once

#include <mrpt/core/bits_math.h>

namespace hybrid_slam {

/// Standard deviations of the drift per sqrt(m) of path: in x and in y (m), and in heading (rad). They are
/// the usual ones, for covariances and as weights, tuned on simulated logs (doc/verdict.md); loop closing
/// searches further (`stepVariance`).
struct PathDrift {
  double position, heading;
};

constexpr PathDrift kDriftWithLines{0.01, mrpt::DEG2RAD(0.019)};
constexpr PathDrift kDriftWithoutLines{0.028, mrpt::DEG2RAD(0.058)};

}  // namespace hybrid_slam
