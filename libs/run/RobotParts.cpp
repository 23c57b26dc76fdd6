#include "run/RobotParts.h"

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <algorithm>
#include <cmath>

#include "base/Degree.h"

namespace hybrid_slam::run {

namespace {

constexpr double kMoved = 0.05, kTurned = 5 * kDegree;  // between two readings that count
constexpr double kLeastWay = 3, kLeastTurn = 90 * kDegree;
constexpr float kLongest = 0.4F, kSpread = 0.05F;  // m
constexpr double kFewest = 0.8,
                 kOutside = 0.02;  // share of the scans with a range; above and below the spread
constexpr size_t kFewestScans = 40, kFewestBeams = 3;

}  // namespace

void RobotParts::add(const readings::Reading& reading) {
  moved_ = moved_ + reading.motion;
  if (moved_.norm() < kMoved && std::abs(moved_.phi) < kTurned) return;
  way_ += moved_.norm();
  turned_ += std::abs(moved_.phi);
  moved_ = {};
  for (const auto& scan : reading.scans) {
    Laser& laser = lasers_[scan->sensorLabel];
    ++laser.scans;
    laser.ranges.resize(std::max(laser.ranges.size(), scan->getScanSize()));
    for (size_t i = 0; i < scan->getScanSize(); ++i)
      if (scan->getScanRangeValidity(i)) laser.ranges[i].push_back(scan->getScanRange(i));
  }
}

double RobotParts::farthest() const {
  if (way_ < kLeastWay || turned_ < kLeastTurn) return 0;
  double farthest = 0;
  for (const auto& [label, laser] : lasers_) {
    if (laser.scans < kFewestScans) continue;
    std::vector<double> ends;  // of the beams at the robot
    for (std::vector<float> ranges : laser.ranges) {
      if (static_cast<double>(ranges.size()) < kFewest * static_cast<double>(laser.scans)) continue;
      std::sort(ranges.begin(), ranges.end());
      const auto outside = static_cast<size_t>(kOutside * static_cast<double>(ranges.size()));
      const float low = ranges[outside], high = ranges[ranges.size() - 1 - outside];
      if (high < kLongest && high - low < kSpread) ends.push_back(high);
    }
    if (ends.size() >= kFewestBeams)
      farthest = std::max(farthest, *std::max_element(ends.begin(), ends.end()));
  }
  return farthest;
}

}  // namespace hybrid_slam::run
