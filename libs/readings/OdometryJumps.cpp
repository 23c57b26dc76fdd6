#include "readings/OdometryJumps.h"

#include <algorithm>
#include <utility>

namespace hybrid_slam::readings {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace {

constexpr double kShortest = 0.5;     // m: shorter steps never count as jumps
constexpr double kAcceleration = 5;   // times the highest speed so far
constexpr double kLeastTime = 0.1;    // s: readings may arrive in bursts, with nearly equal times
constexpr double kUnknownTime = 1;    // s: assumed between readings without time
constexpr double kSpeedWindow = 0.5;  // s: over which the robot's speed is measured
constexpr double kSimilar = 0.5;      // of the previous speed, between steps of one motion

}  // namespace

bool OdometryJumps::isJump(const TPose2D& reading, std::optional<double> time) {
  const Reading now{TPoint2D(reading), time};
  const Reading before = std::exchange(last_, now).value_or(now);
  const TPoint2D fastBefore = std::exchange(fast_, TPoint2D(0, 0));
  const TPoint2D step = now.at - before.at;
  const double passed = time && before.time ? *time - *before.time : kUnknownTime;
  const TPoint2D velocity = step * (1 / (passed > 0 ? std::max(passed, kLeastTime) : kUnknownTime));
  const bool isTooFast = step.norm() > kShortest && velocity.norm() > kAcceleration * fastest_;
  const bool continues = (velocity - fastBefore).norm() < kSimilar * fastBefore.norm();
  if (step.norm() > kMaxStep || (isTooFast && !continues)) {
    fast_ = velocity, moved_ = {0, 0}, elapsed_ = 0;
    return true;
  }
  if (isTooFast) fastest_ = velocity.norm();
  moved_ += step, elapsed_ += std::max(passed, 0.0);
  if (elapsed_ >= kSpeedWindow) {
    fastest_ = std::max(fastest_, moved_.norm() / elapsed_);
    moved_ = {0, 0}, elapsed_ = 0;
  }
  return false;
}

}  // namespace hybrid_slam::readings
