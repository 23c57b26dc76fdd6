/// @file OdometryContinuity.h
/// @brief Keeps odometry continuous when a robot's counters restart.
#pragma once

#include <mrpt/math/TPose2D.h>
#include <mrpt/obs/CObservation.h>

#include <optional>

#include "readings/ReadingAssembler.h"

namespace hybrid_slam::live {

/// Counters restart from zero when a robot is power-cycled or a driver reconnects. The motion in between is
/// unknown, so the pose continues from the last one as if the robot had stood still. The same applies to
/// impossible jumps (readings::isJump).
class OdometryContinuity {
 public:
  /// Announces that the next pose is in a new frame.
  void restart() { isNewFrame_ = true; }

  /// @param pose  as reported by the robot (m, rad)
  /// @return the pose in the first frame; bit-identical until the first restart
  mrpt::math::TPose2D operator()(const mrpt::math::TPose2D& pose) {
    if (told_ && (isNewFrame_ || readings::isJump(*told_, pose)))
      start_ = Start{last_.value_or(mrpt::math::TPose2D()), pose};
    isNewFrame_ = false;
    told_ = pose;
    last_ = start_ ? start_->here + (pose - start_->there) : pose;
    return *last_;
  }

 private:
  struct Start {
    mrpt::math::TPose2D here, there;  ///< the same pose in the first and in the current frame
  };
  bool isNewFrame_ = false;
  std::optional<Start> start_;
  std::optional<mrpt::math::TPose2D> told_,
      last_;  ///< the previous pose, as reported and as returned
};

/// Transforms an odometry observation into the first frame; ignores others, and impossible odometry.
void rebase(mrpt::obs::CObservation& observation, OdometryContinuity& continuity);

}  // namespace hybrid_slam::live
