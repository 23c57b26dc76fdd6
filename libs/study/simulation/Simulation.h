/// @file Simulation.h
/// @brief Simulates a robot on a route through a floor plan: observations and ground truth.
#pragma once

#include <mrpt/core/Clock.h>
#include <mrpt/math/TPose2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <vector>

#include "base/Options.h"
#include "study/simulation/Laser.h"
#include "study/simulation/WheelOdometry.h"

namespace hybrid_slam::simulation {

class BuildingPlan;
class Route;

/// Pose of the robot's centre in the frame of the floor plan (m, rad).
struct TruePose {
  mrpt::Clock::time_point timestamp;
  mrpt::math::TPose2D pose;
};

/// Output of a simulation run. `scans`, `groundTruth` and `odometryAtScans` have one entry per scan;
/// `odometry` has its own times.
struct SimulatedLog {
  std::vector<mrpt::obs::CObservation2DRangeScan::Ptr> scans;
  std::vector<mrpt::math::TPose2D> odometryAtScans;  ///< odometry pose at each scan
  std::vector<mrpt::obs::CObservationOdometry::Ptr> odometry;
  std::vector<TruePose> groundTruth;  ///< at the first beam of each scan
  double scanTime = 0;                ///< s, from the first beam to the last
};

/// The two forms of rawlogs: single observations, or pairs of an action and observations.
enum class RawlogForm { observations, pairs };

/// INI section [simulation].
struct SimulationOptions : Options {
  std::string plan, things, route;
  RawlogForm form = RawlogForm::observations;
  int seed = 1;
  int session = 1;
  int scans = 0;
  double startTime = 1287388800;  // 2010-10-18 08:00:00 UTC
  double robotRadius = 0.27;      ///< m
  void describe(OptionTable& table) override;
};

/// Scans at 0, 1/rate, 2/rate ... s; odometry readings have a separate rate and a phase offset of 30 ms, as
/// with two devices. The same options (with seed and session) give the same log.
/// @throws InputError for a route that touches walls, or is too short for the number of scans
SimulatedLog simulate(const BuildingPlan& plan, const Route& route, const SimulationOptions& options,
                      const LaserOptions& laser, const OdometryOptions& odometry);

}  // namespace hybrid_slam::simulation
