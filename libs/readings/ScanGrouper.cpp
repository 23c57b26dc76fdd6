#include "readings/ScanGrouper.h"

#include <algorithm>
#include <cmath>

#include "base/LaserScan.h"
#include "readings/ReadingAssembler.h"

namespace hybrid_slam::readings {

namespace {

/// Of the time between two scans of a laser: scans further apart are of different cycles. If a log begins
/// within a cycle, the readings would else have one laser's scan of each cycle and the other's of the next.
constexpr double kSameCycle = 0.6;

}  // namespace

std::vector<std::string> labelsOf(const std::string& list) {
  constexpr const char* kBlanks = " \t";
  std::vector<std::string> labels;
  for (size_t begin = 0; begin <= list.size();) {
    const size_t end = std::min(list.find(',', begin), list.size());
    const std::string field = list.substr(begin, end - begin);
    const size_t first = field.find_first_not_of(kBlanks);
    if (first != std::string::npos)
      labels.push_back(field.substr(first, field.find_last_not_of(kBlanks) - first + 1));
    begin = end + 1;
  }
  return labels;
}

ScanGrouper::ScanGrouper(const std::vector<std::string>& lasers, double maxGap, bool isPlaced)
    : wanted_(lasers), maxGap_(maxGap), isPlaced_(isPlaced) {}

ScanGrouper::Use ScanGrouper::useOf(const mrpt::obs::CObservation2DRangeScan& scan) const {
  const bool isNamed = std::find(wanted_.begin(), wanted_.end(), scan.sensorLabel) != wanted_.end();
  if (!wanted_.empty() && !isNamed) return Use::unwanted;
  if (!hasBeams(scan)) return Use::empty;
  if (isPlaced_) return known_.empty() || known_.count(scan.sensorLabel) > 0 ? Use::taken : Use::second;
  if (!(scan.sensorPose.norm() <= kMaxSensorDistance)) return Use::misplaced;
  if (!isHorizontal(scan)) return Use::tilted;
  if (isNamed) return Use::taken;
  return known_.size() < kMaxLasers || known_.count(scan.sensorLabel) > 0 ? Use::taken : Use::tooMany;
}

size_t ScanGrouper::add(const mrpt::obs::CObservation2DRangeScan& scan) {
  const double time =
      scan.timestamp == INVALID_TIMESTAMP ? firstTime_ : mrpt::Clock::toDouble(scan.timestamp);
  expect(scan.sensorLabel);
  const double gap = std::abs(time - firstTime_);
  const auto before = times_.find(scan.sensorLabel);
  const bool isNextCycle = before != times_.end() && gap > kSameCycle * std::abs(time - before->second);
  const bool isNew = isComplete_ || present_.count(scan.sensorLabel) > 0 || gap > maxGap_ || isNextCycle;
  times_[scan.sensorLabel] = time;
  if (isNew) {
    ++readings_;
    present_.clear();
    firstTime_ = time;
  }
  present_.insert(scan.sensorLabel);
  isComplete_ = present_.size() == known_.size();
  return readings_;
}

std::string reasonOf(ScanGrouper::Use use) {
  switch (use) {
    case ScanGrouper::Use::unwanted:
      return "not in [input] sensor_label";
    case ScanGrouper::Use::misplaced:
      return "its sensor pose is over 100 m from the robot";
    case ScanGrouper::Use::tilted:
      return "its scan plane is tilted";
    case ScanGrouper::Use::second:
      return "[input] laser_pose is the pose of one laser";
    case ScanGrouper::Use::tooMany:
      return "more than " + std::to_string(kMaxLasers) + " lasers";
    default:
      return "no beams";
  }
}

}  // namespace hybrid_slam::readings
