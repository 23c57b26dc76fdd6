/// @file DoubledWalls.h
/// @brief Share of walls that a run's map shows twice.
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "files/Trajectory.h"
#include "readings/EndPoints.h"
#include "study/simulation/BuildingPlan.h"

namespace hybrid_slam::comparison {

/// The scans of a log that saw each wall sample, from the true poses; computed once per log.
///
/// Walls are sampled every 0.1 m. A scan sees a sample if it is the nearest one to an end point of the scan
/// at the true pose, within 0.15 m. Scans less than 0.2 m and 10 deg from the previous one are skipped.
class WallSightings {
 public:
  /// @param reference  true poses in the plan's frame
  /// @param tolerance  s; largest time difference between a scan and its true pose; scans without one are
  ///                   skipped
  WallSightings(const simulation::BuildingPlan& plan, const files::Trajectory& reference,
                const std::vector<readings::EndPoints>& scans, double tolerance);

  /// True if no scan sees a wall.
  bool empty() const;

  /// Doubled / shown samples, in [0, 1]; empty for a run that shows none.
  ///
  /// A scan taken at the true pose T and placed at R by the run draws the sample w at R + inverse(T) + w: its
  /// *image* in the run's map. No map alignment is needed, and laser noise cancels. A sample is *shown* if it
  /// has an image. Offsets between images are measured along the mean wall normal in the run's map: an offset
  /// along a wall does not double it. A sighting more than 30 s after the previous one begins a new *pass*;
  /// passes of fewer than 3 scans are ignored. A sample is *spread* if the median offsets of two passes
  /// differ by more than 0.2 m, or the 10th and 90th percentile within a pass do. It is *doubled* if it is
  /// one of at least 3 consecutive spread samples of its wall.
  /// @param run  scans count if it has a pose within 0.001 s
  std::optional<double> doubledShare(const files::Trajectory& run) const;

 private:
  struct Scan {
    double timestamp;          ///< s
    mrpt::math::TPose2D pose;  ///< true
  };
  struct Sample {
    mrpt::math::TPoint2D at, normal;
    size_t wall;                  ///< of the plan
    std::vector<uint32_t> scans;  ///< that saw it, in log order
  };
  std::vector<Scan> scans_;
  std::vector<Sample> samples_;  ///< wall by wall, in order along each
};

}  // namespace hybrid_slam::comparison
