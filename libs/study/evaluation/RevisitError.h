/// @file RevisitError.h
/// @brief Map consistency at revisited places, without a reference.
#pragma once

#include <cstddef>
#include <vector>

#include "files/Trajectory.h"
#include "readings/EndPoints.h"
#include "study/evaluation/ErrorStatistics.h"

namespace hybrid_slam::evaluation {

/// When a scan counts as a revisit.
struct RevisitOptions {
  double distance = 3;  ///< m; largest distance between the poses of two scans at one place
  double path = 20;     ///< m; least distance driven between the two
};

/// The errors over all revisits.
struct RevisitErrors {
  size_t scans = 0;       ///< with a pose
  size_t revisits = 0;    ///< of these, with beams and an earlier scan of the place
  size_t apart = 0;       ///< of these, with too few compared beams
  ErrorStatistics error;  ///< over the revisits, m; zeros if there are none
  double p95 = 0;         ///< m; 95th percentile: the smallest error that at least 95 % do not exceed
};

/// Places the end points of every scan in the map by the trajectory's pose at its time (within 0.001 s; scans
/// without one are skipped). A scan is a revisit if an earlier scan's pose is within `distance` of its own,
/// with at least `path` driven in between, both along the trajectory.
///
/// Each end point is compared with the nearest end point of these earlier scans if that is less than 0.5 m
/// away; otherwise it shows another part of the room. The error of a point is its distance to the segments
/// between the nearest point and the end points of the adjacent beams within 0.3 m, or else to the nearest
/// point itself: two scans never hit a wall at the same points. The scan's revisit error is the median over
/// the compared points (for an even number, the upper middle one). If less than 30 % of the points are
/// compared, the scan is apart: the walls do not meet, and its error counts as 0.5 m.
/// @param scans  in log order
/// @throws InputError if no scan has a pose
RevisitErrors revisitErrors(const files::Trajectory& trajectory,
                            const std::vector<readings::EndPoints>& scans, const RevisitOptions& options);

}  // namespace hybrid_slam::evaluation
