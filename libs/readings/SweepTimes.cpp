#include "readings/SweepTimes.h"

#include <cmath>
#include <limits>
#include <utility>

#include "base/Numbers.h"
#include "files/ObjectWalk.h"
#include "readings/Timestamps.h"

namespace hybrid_slam::readings {
namespace {

const std::string kBeginning = "scan_time = ", kMiddle = " s, laser ";

}  // namespace

std::optional<double> SweepSetting::of(double aperture) const {
  if (!rate) return seconds;
  const double sweep = aperture / (2 * M_PI) / *rate;
  return isSweepTime(sweep) ? sweep : 0;
}

mrpt::obs::CObservationComment::Ptr commentOf(const SweepTime& sweep, mrpt::Clock::time_point timestamp) {
  auto comment = mrpt::obs::CObservationComment::Create();
  comment->timestamp = timestamp;
  comment->text = kBeginning + numberText(sweep.seconds) + kMiddle + sweep.label;
  return comment;
}

std::optional<SweepTime> sweepTimeIn(const mrpt::obs::CObservation& observation) {
  const auto* comment = dynamic_cast<const mrpt::obs::CObservationComment*>(&observation);
  if (!comment || comment->text.rfind(kBeginning, 0) != 0) return std::nullopt;
  const size_t middle = comment->text.find(kMiddle, kBeginning.size());
  if (middle == std::string::npos) return std::nullopt;
  std::string label = comment->text.substr(middle + kMiddle.size());
  if (label.size() > files::kLongestLabel) return std::nullopt;  // no laser has it
  const auto seconds = parseFinite(comment->text.substr(kBeginning.size(), middle - kBeginning.size()));
  return SweepTime{std::move(label), seconds.value_or(std::numeric_limits<double>::quiet_NaN())};
}

double SweepTimes::of(const mrpt::obs::CObservation2DRangeScan& scan) const {
  if (!isStamped(scan) || scan.getScanSize() < 2) return 0;
  if (const auto set = setting_.of(scan.aperture)) return *set;
  const auto stated = stated_.find(scan.sensorLabel);
  return stated == stated_.end() ? 0 : stated->second;
}

}  // namespace hybrid_slam::readings
