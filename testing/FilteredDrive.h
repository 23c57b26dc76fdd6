/// @file FilteredDrive.h
/// @brief For the tests: a drive through a filter, with its path beside the true one and the odometry's.
#pragma once

#include <vector>

#include "slam/filter/Filter.h"
#include "testing/RingDrive.h"

namespace hybrid_slam::test {

/// One pose for each update (m, rad); `path` is the filter's.
struct FilteredDrive {
  std::vector<TPose2D> path, truth, odometry;
};

inline FilteredDrive filtered(Filter& filter, const std::vector<DrivenPose>& drive) {
  FilteredDrive result;
  TPose2D odometry = drive[0].truth;
  for (const DrivenPose& driven : drive) {
    const size_t before = filter.updates();
    filter.process(driven.motion, observed(driven.scans[0]));
    odometry = odometry + driven.motion;
    if (filter.updates() == before) continue;
    result.truth.push_back(driven.truth);
    result.odometry.push_back(odometry);
  }
  result.path = filter.bestPath();
  return result;
}

}  // namespace hybrid_slam::test
