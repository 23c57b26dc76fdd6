/// @file DriveLog.h
/// @brief For the tests: the drive of TestRoom.h as a log.
#pragma once

#include "testing/TestLogs.h"
#include "testing/TestRoom.h"

namespace hybrid_slam::test {

/// Makes a log with an odometry reading and a scan at the same time, 5 per second from 1000 s on.
inline Log logOf(const std::vector<DriveStep>& steps) {
  Log log;
  TPose2D pose;
  for (const DriveStep& step : steps) {
    pose = pose + step.odometry;
    const double time = 1000 + 0.1 * static_cast<double>(log.size());
    auto scan = CObservation2DRangeScan::Create(step.scan);
    scan->timestamp = stamp(time);
    scan->sensorLabel = "LASER";
    log.push_back(odometry(time, pose));
    log.push_back(scan);
  }
  return log;
}

}  // namespace hybrid_slam::test
