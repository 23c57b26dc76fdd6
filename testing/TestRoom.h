/// @file TestRoom.h
/// @brief For the tests: a robot that drives squares in a simulated room, with a laser and poor odometry.
#pragma once

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/slam/CMetricMapBuilder.h>

#include <vector>

#include "slam/filter/FilterOptions.h"
#include "slam/filter/FilterView.h"
#include "testing/TestScans.h"

namespace hybrid_slam::test {

/// A room of 11 m x 8.5 m with a recess, so that no two places look alike; the robot starts at the origin.
inline Walls room() {
  return polygon({{-3, -2.5}, {8, -2.5}, {8, 6}, {3, 6}, {3, 5}, {1, 5}, {1, 6}, {-3, 6}});
}

/// A scan of 181 beams over 180 deg, 80 m, with 1 cm of noise, 0.2 m ahead of the robot's centre.
inline mrpt::obs::CObservation2DRangeScan observationOf(const Walls& walls, const TPose2D& robot,
                                                        RandomStream& random) {
  const TPose2D sensor(0.2, 0, 0);
  const LaserScan seen = scanOf(walls, robot, sensor, 181, M_PI, 0.01, random);
  mrpt::obs::CObservation2DRangeScan out;
  out.aperture = static_cast<float>(M_PI);
  out.maxRange = 80;
  out.sensorPose = mrpt::poses::CPose3D(sensor);
  out.resizeScan(seen.beams.size());
  for (size_t i = 0; i < seen.beams.size(); ++i) {
    out.setScanRange(i, static_cast<float>(std::min(seen.beams[i].range, 80.0)));
    out.setScanRangeValidity(i, seen.beams[i].range < 80);
  }
  return out;
}

inline mrpt::obs::CObservation2DRangeScan roomScan(const TPose2D& robot, RandomStream& random) {
  return observationOf(room(), robot, random);
}

struct DriveStep {
  TPose2D odometry;  ///< increment
  TPose2D truth;
  mrpt::obs::CObservation2DRangeScan scan;
};

/// Drives `sides` sides of a square of 4 m in steps of 0.25 m and 15 deg. Odometry distances are 3 % too long
/// and turns 4 % too small, with noise of 1 cm and 0.3 deg per step.
inline std::vector<DriveStep> drive(int sides, uint64_t seed = 1) {
  RandomStream random(seed, 0, 0);
  std::vector<DriveStep> steps = {{{}, {}, roomScan({}, random)}};
  const auto go = [&](const TPose2D& motion) {
    const TPose2D odometry(1.03 * motion.x + 0.01 * random.gaussian(), 0.01 * random.gaussian(),
                           0.96 * motion.phi + 0.3 * kDegree * random.gaussian());
    const TPose2D truth = steps.back().truth + motion;
    steps.push_back({odometry, truth, roomScan(truth, random)});
  };
  for (int side = 0; side < sides; ++side) {
    for (int i = 0; i < 16; ++i) go({0.25, 0, 0});
    for (int i = 0; i < 6; ++i) go({0, 0, 15 * kDegree});
  }
  return steps;
}

inline mrpt::obs::CActionCollection actionOf(const TPose2D& odometry) {
  mrpt::obs::CActionCollection action;
  action.insert(toAction(odometry, MotionModelOptions()));
  return action;
}

inline void feed(mrpt::slam::CMetricMapBuilder& builder, const DriveStep& step) {
  auto action = actionOf(step.odometry);
  mrpt::obs::CSensoryFrame observations;
  observations.insert(mrpt::obs::CObservation2DRangeScan::Create(step.scan));
  builder.processActionObservation(action, observations);
}

/// Poses of the robot at the filter updates.
struct Replayed {
  std::vector<TPose2D> truth, odometry;
};

inline Replayed feed(mrpt::slam::CMetricMapBuilder& builder, const FilterView& view,
                     const std::vector<DriveStep>& steps) {
  Replayed replayed;
  TPose2D odometry;
  for (const DriveStep& step : steps) {
    const size_t before = view.updates();
    feed(builder, step);
    odometry = odometry + step.odometry;
    if (view.updates() == before) continue;
    replayed.truth.push_back(step.truth);
    replayed.odometry.push_back(odometry);
  }
  return replayed;
}

/// Root mean square of the distances, m.
inline double rms(const std::vector<TPose2D>& path, const std::vector<TPose2D>& truth) {
  double sum = 0;
  for (size_t i = 0; i < path.size(); ++i)
    sum += std::pow(path[i].x - truth.at(i).x, 2) + std::pow(path[i].y - truth.at(i).y, 2);
  return std::sqrt(sum / static_cast<double>(path.size()));
}

/// The default configuration with a proposal.
inline FilterConfiguration with(ParticleFilterOptions::Proposal proposal) {
  FilterConfiguration c;
  c.filter.proposal = proposal;
  return c;
}

/// A configuration with 20 particles and the motion model that fits the drive's odometry.
inline FilterConfiguration roomConfiguration() {
  FilterConfiguration c;
  c.filter.particles = 20;
  c.filter.proposal = ParticleFilterOptions::Proposal::standard;
  c.motion.turn.varianceT = 0.05 * 0.05;
  return c;
}

}  // namespace hybrid_slam::test
