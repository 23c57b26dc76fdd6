/// @file ScanOdometry.h
/// @brief The robot's motion from its scans, where there is no odometry.
#pragma once

#include <deque>
#include <optional>

#include "base/LaserScan.h"
#include "slam/grid/OccupancyGrid.h"
#include "slam/grid/ScanMatcher.h"

namespace hybrid_slam {

/// Matches each scan to a local map of the previous scans, around the pose that the motion of the last step
/// predicts. In directions that the scan does not constrain, as along a corridor, the prediction remains.
///
/// The map holds the last few keyframes, so that a robot that stands still does not drift. A scan that does
/// not fit starts a new map; the filter's slip recovery then has to find this step. After a scan without
/// returns the robot is assumed to move on, by half as much after each further one.
class ScanOdometry {
 public:
  ScanOdometry(const GridOptions& grid, const ScanMatcherOptions& matcher);

  /// Returns the motion since the previous scans, in the robot frame at those (m, rad); zero for the first
  /// scans.
  /// @param timestamp  s; if the step is shorter than the last one, the predicted motion is scaled down
  /// @param turn  rad, since the previous scans, where it is measured: replaces the predicted one if that is
  /// over 10 deg off
  mrpt::math::TPose2D motionTo(const Scans& observed, double timestamp, std::optional<double> turn = {});
  /// Sets the motion (m, rad) and duration (s) of the last step, from which the next one is predicted.
  void setLastMotion(const mrpt::math::TPose2D& motion, double duration) {
    lastMotion_ = motion, lastDuration_ = duration;
  }

  template <class State>
  void visit(State& state) {
    state(keyframes_, pose_, lastMotion_, lastDuration_, lastTime_);
    for (const Keyframe& keyframe : keyframes_)
      state.check(keyframe.beams.areWithin(grid_.maxRange), "a beam is too long");
    if constexpr (State::kIsReading) makeMap();
  }

 private:
  mrpt::math::TPose2D predicted(double duration) const;
  struct Keyframe {
    ScanBeams beams;
    mrpt::math::TPose2D pose;

    template <class State>
    void visit(State& state) {
      state(beams, pose);
    }
  };
  ScanMatch match(const ScanBeams& beams, const mrpt::math::TPose2D& expected) const;
  void addKeyframe(const ScanBeams& beams);
  void makeMap();

  GridOptions grid_;
  int matchedBeams_;
  ScanMatcher matcher_;
  std::deque<Keyframe> keyframes_;
  OccupancyGrid map_;         ///< of the keyframes
  mrpt::math::TPose2D pose_;  ///< frame of the first scan
  mrpt::math::TPose2D lastMotion_;
  double lastDuration_ = 0, lastTime_ = 0;  ///< s
};

}  // namespace hybrid_slam
