/// @file RevisitError.h
/// @brief Does a map close? Judged without a reference, by the walls that the robot sees again.
#pragma once

#include <cstddef>
#include <vector>

#include "files/Trajectory.h"
#include "readings/EndPoints.h"
#include "study/evaluation/ErrorStatistics.h"

namespace hybrid_slam::evaluation {

struct RevisitOptions {
  double distance = 3;  ///< m; no farther apart are the poses of a scan and of one that it revisits
  double path = 20;     ///< m; at least so long is the way driven between the two
};

struct RevisitErrors {
  size_t scans = 0;       ///< that have a pose
  size_t revisits = 0;    ///< of these, with beams and something to revisit
  size_t apart = 0;       ///< of these, with too few beams compared
  ErrorStatistics error;  ///< over the revisits, m; zeros where there are none
  double p95 = 0;         ///< m; the smallest of the errors that at least 95 % of them do not exceed
};

/// Places the end points of every scan in the map, by the trajectory's pose at the scan's time (within
/// 0.001 s; scans without one are left out). A scan revisits where there are scans before it whose poses are
/// within `distance` of its own, with at least `path` of way driven in between, both by the trajectory.
///
/// Each of its end points is compared with the nearest end point of these earlier scans, if that is less than
/// 0.5 m away; else it shows another part of the room. Its error is the distance to the lines from the
/// nearest point to the end points of the beams before and after it, where these are within 0.3 m of it, and
/// to the nearest point itself elsewhere: that the beams of two scans never meet a wall at the same places is
/// no error. The scan's revisit error is the median over the points compared (of an even number the upper of
/// the two in the middle). With less than 30 % of them compared the scan is apart, the walls do not meet at
/// all: its error counts as 0.5 m.
/// @param scans  in the order in which they were taken
/// @throws InputError if no scan has a pose
RevisitErrors revisitErrors(const files::Trajectory& trajectory,
                            const std::vector<readings::EndPoints>& scans, const RevisitOptions& options);

}  // namespace hybrid_slam::evaluation
