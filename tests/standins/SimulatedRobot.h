/// @file SimulatedRobot.h
/// @brief The robot that carries the stand-ins: drives along a route, one step per scan.
#pragma once

#include <mrpt/math/TPose2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include <mutex>
#include <string>
#include <vector>

#include "base/RandomStream.h"
#include "study/simulation/BuildingPlan.h"
#include "study/simulation/Laser.h"
#include "study/simulation/Route.h"

namespace hybrid_slam::test {

class SimulatedRobot {
 public:
  /// @param step  s of the route from one scan to the next
  SimulatedRobot(const std::string& plan, const std::string& route, double step)
      : plan_(simulation::BuildingPlan::load(plan)),
        route_(simulation::Route::load(route)),
        step_(step),
        laser_(options()) {}

  /// Takes the next step and a scan: 541 beams of an LMS-100, right to left.
  mrpt::obs::CObservation2DRangeScan scan() {
    const std::lock_guard<std::mutex> lock(mutex_);
    RandomStream random(1, scans_.size(), 0);
    poses_.push_back(route_.poseAt(step_ * static_cast<double>(scans_.size())));
    scans_.push_back(laser_.scan(plan_, poses_.back(), random));
    return scans_.back();
  }
  /// Pose (m, rad) since the start, without error.
  mrpt::math::TPose2D odometry() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return poses_.empty() ? mrpt::math::TPose2D() : poses_.back() - poses_.front();
  }
  std::vector<mrpt::obs::CObservation2DRangeScan> scans() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return scans_;
  }

 private:
  static simulation::LaserOptions options() {
    simulation::LaserOptions laser;
    laser.x = 0.15;
    return laser;
  }

  simulation::BuildingPlan plan_;
  simulation::Route route_;
  double step_;
  simulation::Laser laser_;
  mutable std::mutex mutex_;
  std::vector<mrpt::math::TPose2D> poses_;
  std::vector<mrpt::obs::CObservation2DRangeScan> scans_;
};

}  // namespace hybrid_slam::test
