/// @file OdometryContinuity.h
/// @brief Odometry that goes on where it was when a robot's counters start anew.
#pragma once

#include <mrpt/math/TPose2D.h>
#include <mrpt/obs/CObservation.h>

#include <optional>

#include "readings/ReadingAssembler.h"

namespace hybrid_slam::live {

/// A robot that is switched off and on, and a driver that connects again, count from zero. What happened in
/// between is not known: the pose goes on from the last one as if the robot had stood still. So it does over
/// a jump that no robot makes, which a replay of the recording would refuse.
class OdometryContinuity {
 public:
  /// The next pose is in a frame of its own.
  void restart() { isNewFrame_ = true; }

  /// @param pose  as the robot tells it (m, rad)
  /// @return the pose in the frame of the very first one; the same bits until the first restart
  mrpt::math::TPose2D operator()(const mrpt::math::TPose2D& pose) {
    if (told_ && (isNewFrame_ || (pose - *told_).norm() > readings::kMaxStep)) start_ = Start{*last_, pose};
    isNewFrame_ = false;
    told_ = pose;
    last_ = start_ ? start_->here + (pose - start_->there) : pose;
    return *last_;
  }

 private:
  struct Start {
    mrpt::math::TPose2D here, there;  ///< one moment in the first frame and in the present one
  };
  bool isNewFrame_ = false;
  std::optional<Start> start_;
  std::optional<mrpt::math::TPose2D> told_,
      last_;  ///< the one before, as the robot told it and as it was given
};

/// Puts an observation, if it is odometry, into the first frame.
void rebase(mrpt::obs::CObservation& observation, OdometryContinuity& continuity);

}  // namespace hybrid_slam::live
