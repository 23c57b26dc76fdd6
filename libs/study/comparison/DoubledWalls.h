/// @file DoubledWalls.h
/// @brief How much of the walls a run draws twice, told by where it saw them from.
#pragma once

#include <mrpt/math/TPoint2D.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "files/Trajectory.h"
#include "readings/EndPoints.h"
#include "study/simulation/FloorPlan.h"

namespace hybrid_slam::comparison {

/// Which scans of a log saw which piece of wall, as the true poses tell: made once for all runs on the log.
///
/// Every wall is sampled each 0.1 m. A scan sees a sample if this is the nearest one to the end of one of its
/// beams at the true pose, and within 0.15 m of it. Scans less than 0.2 m and 10 deg from the one before are
/// passed over.
class WallSightings {
 public:
  /// @param reference  true poses in the plan's frame
  /// @param tolerance  s; between a scan and its true pose; scans without one are left out
  WallSightings(const simulation::FloorPlan& plan, const files::Trajectory& reference,
                const std::vector<readings::EndPoints>& scans, double tolerance);

  /// Whether no scan sees a wall.
  bool empty() const;

  /// Doubled / shown samples, in [0, 1]; nothing for a run that shows none.
  ///
  /// A scan that was taken at the pose T and that the run places at R draws the sample w at R + inverse(T) +
  /// w: its *image* in the run's map. No alignment of the map enters, and the laser's noise cancels. A sample
  /// is *shown* if it has an image. Offsets between images are measured along the wall's normal, as these
  /// scans drew it on average: what moves along a wall does not double it. A sighting more than 30 s after
  /// the one before begins another *pass*; those of fewer than 3 scans draw no wall and are left out. The
  /// sample is *spread* if the median offsets of two passes differ by more than 0.2 m, or if within a pass
  /// the 10th and the 90th percentile do. It is *doubled* if it is one of at least 3 spread samples in a row
  /// on its wall.
  /// @param run  scans count that it has a pose for, within 0.001 s
  std::optional<double> doubledShare(const files::Trajectory& run) const;

 private:
  struct Scan {
    double timestamp;          ///< s
    mrpt::math::TPose2D pose;  ///< true
  };
  struct Sample {
    mrpt::math::TPoint2D at, normal;
    size_t wall;                  ///< of the plan
    std::vector<uint32_t> scans;  ///< that saw it, in the order of the log
  };
  std::vector<Scan> scans_;
  std::vector<Sample> samples_;  ///< wall by wall, along each
};

}  // namespace hybrid_slam::comparison
