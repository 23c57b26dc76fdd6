#include "run/OdometryTimeOffset.h"

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <algorithm>
#include <cmath>

#include "base/BeamFan.h"
#include "base/Degree.h"

namespace hybrid_slam::run {

using mrpt::obs::CObservation2DRangeScan;

namespace {

constexpr double kLargestOffset = 10, kOffsetStep = 0.05;  // s
constexpr double kShortestPause = 0.1, kLongestPause = 1;  // s between two scans that are compared
constexpr double kBeamStep = kDegree, kLargestTurn = 90 * kDegree;
constexpr float kFarRange = 10, kOtherWall = 0.5F;  // m; larger differences count as this
constexpr double kOtherTurn = 10 * kDegree;         // larger differences count as this
constexpr size_t kFewestPairs = 100, kMostPairs = 5000;
constexpr double kLeastTurned = 270 * kDegree;
constexpr double kBetterThanNone = 0.85;    // misfit of the best offset, of that of none
constexpr double kBetterThanNoTurns = 0.8;  // and of that of odometry that does not turn
constexpr double kSame = 0.2;               // s

/// Returns the ranges (m) of about one beam per degree, counter-clockwise.
/// @param stride  beams
std::vector<float> rangesOf(const CObservation2DRangeScan& scan, size_t stride) {
  std::vector<float> ranges;
  for (size_t i = 0; i < scan.getScanSize(); i += stride)
    ranges.push_back(scan.getScanRangeValidity(i) ? std::min(scan.getScanRange(i), kFarRange) : kFarRange);
  if (BeamFan(scan).isReversed()) std::reverse(ranges.begin(), ranges.end());
  return ranges;
}

/// Returns the mean difference (m) between the ranges of a scan and those of the scan before, which saw them
/// `shift` beams farther to the left.
double meanDifference(const std::vector<float>& before, const std::vector<float>& after, int shift) {
  const int beams = static_cast<int>(before.size());
  const int begin = std::max(0, -shift), end = std::min(beams, beams - shift);
  double sum = 0;
  for (int i = begin; i < end; ++i)
    sum += std::min(std::abs(before[static_cast<size_t>(i + shift)] - after[static_cast<size_t>(i)]),
                    kOtherWall);
  return sum / (end - begin);
}

/// Returns how far a laser has turned between two scans with equal beams (rad).
double turnBetween(const CObservation2DRangeScan& one, const CObservation2DRangeScan& other) {
  const double spacing = one.aperture / static_cast<double>(one.getScanSize() - 1);
  const auto stride = static_cast<size_t>(
      std::clamp(std::round(kBeamStep / spacing), 1.0, static_cast<double>(one.getScanSize())));
  const double step = spacing * static_cast<double>(stride);
  const std::vector<float> before = rangesOf(one, stride), after = rangesOf(other, stride);
  const auto most = static_cast<int>(std::min(kLargestTurn / step, 0.5 * static_cast<double>(before.size())));
  std::vector<double> differences;
  for (int shift = -most; shift <= most; ++shift) differences.push_back(meanDifference(before, after, shift));
  const auto least = std::min_element(differences.begin(), differences.end());
  double shift = static_cast<double>(least - differences.begin()) - most;
  if (least != differences.begin() && least + 1 != differences.end()) {  // the vertex of a parabola
    const double curvature = least[-1] - 2 * least[0] + least[1];
    if (curvature > 0) shift += (least[-1] - least[1]) / (2 * curvature);
  }
  return shift * step;
}

bool areAlike(const CObservation2DRangeScan& one, const CObservation2DRangeScan& other) {
  return one.sensorLabel == other.sensorLabel && one.getScanSize() == other.getScanSize() &&
         one.aperture == other.aperture && one.getScanSize() > 2 && one.aperture > 0;
}

double offsetAt(size_t index) { return static_cast<double>(index) * kOffsetStep - kLargestOffset; }

double bestOffset(const std::vector<double>& misfits) {
  return offsetAt(static_cast<size_t>(std::min_element(misfits.begin(), misfits.end()) - misfits.begin()));
}

}  // namespace

void OdometryTimeOffset::add(const readings::Reading& reading) {
  heading_ += reading.motion.phi;
  if (!times_.empty() && reading.timestamp <= times_.back()) return;
  times_.push_back(reading.timestamp);
  headings_.push_back(heading_);
  if (reading.scans.empty() || turns_.size() >= kMostPairs) return;
  const auto& scan = reading.scans.back();
  const double pause = reading.timestamp - lastTime_;
  if (lastScan_ && pause < kShortestPause) return;
  if (lastScan_ && pause <= kLongestPause && areAlike(*lastScan_, *scan))
    turns_.push_back({lastTime_, reading.timestamp, turnBetween(*lastScan_, *scan)});
  lastScan_ = scan, lastTime_ = reading.timestamp;
}

double OdometryTimeOffset::headingAt(double time) const {
  const auto after = std::lower_bound(times_.begin(), times_.end(), time);
  if (after == times_.begin()) return headings_.front();
  if (after == times_.end()) return headings_.back();
  const auto i = static_cast<size_t>(after - times_.begin());
  const double share = (time - times_[i - 1]) / (times_[i] - times_[i - 1]);
  return headings_[i - 1] + share * (headings_[i] - headings_[i - 1]);
}

std::vector<double> OdometryTimeOffset::misfits(size_t begin, size_t end) const {
  std::vector<double> sums;
  for (size_t k = 0; offsetAt(k) < kLargestOffset + kOffsetStep / 2; ++k) {
    double sum = 0;
    for (size_t i = begin; i < end; ++i) {
      const double turned = headingAt(turns_[i].to - offsetAt(k)) - headingAt(turns_[i].from - offsetAt(k));
      sum += std::min(std::abs(turns_[i].angle - turned), kOtherTurn);
    }
    sums.push_back(sum);
  }
  return sums;
}

std::optional<double> OdometryTimeOffset::seconds() const {
  double turned = 0, noTurns = 0;
  for (const Turn& turn : turns_) {
    turned += std::abs(turn.angle);
    noTurns += std::min(std::abs(turn.angle), kOtherTurn);
  }
  if (turns_.size() < kFewestPairs || turned < kLeastTurned) return std::nullopt;
  const std::vector<double> first = misfits(0, turns_.size() / 2);
  const std::vector<double> second = misfits(turns_.size() / 2, turns_.size());
  std::vector<double> both = first;
  for (size_t k = 0; k < both.size(); ++k) both[k] += second[k];
  const double offset = bestOffset(both), least = *std::min_element(both.begin(), both.end());
  const double none = both[static_cast<size_t>(std::lround(kLargestOffset / kOffsetStep))];
  const bool isClear = least < kBetterThanNone * none && least < kBetterThanNoTurns * noTurns;
  const bool isSame =
      std::abs(bestOffset(first) - offset) < kSame && std::abs(bestOffset(second) - offset) < kSame;
  return isClear && isSame ? std::optional(offset) : std::nullopt;
}

}  // namespace hybrid_slam::run
