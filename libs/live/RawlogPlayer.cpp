#include "live/RawlogPlayer.h"

#include <mrpt/obs/CObservationOdometry.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <stdexcept>
#include <thread>

#include "files/InputFile.h"
#include "live/CycleGrouper.h"
#include "readings/LogWarnings.h"

namespace hybrid_slam::live {
namespace {

using Clock = std::chrono::steady_clock;
using mrpt::obs::CObservation;
using mrpt::obs::CSensoryFrame;

/// Waits until the time of each cycle.
class Pace {
 public:
  Pace(double rate, const StopCheck& stop) : rate_(rate), stop_(stop) {}

  void wait(const CSensoryFrame& cycle) {
    const double time = timeOf(cycle);
    // Do not wait for a step back, or a gap of minutes between two logs in one file.
    if (count_ == 0 || time < last_ || time - last_ > 60) start_ = Clock::now(), first_ = time, count_ = 0;
    const double due = rate_ > 0 ? static_cast<double>(count_) / rate_ : time - first_;
    ++count_;
    last_ = time;
    constexpr double kNever = 1e9;  // s; longer ones do not fit into the clock
    const auto moment = start_ + std::chrono::duration_cast<Clock::duration>(
                                     std::chrono::duration<double>(std::min(due, kNever)));
    while (!stop_() && Clock::now() < moment)
      std::this_thread::sleep_until(std::min(moment, Clock::now() + std::chrono::milliseconds(50)));
  }

 private:
  double timeOf(const CSensoryFrame& cycle) const {
    double newest = last_;
    bool isFirst = true;
    for (const auto& observation : cycle) {
      if (observation->timestamp == INVALID_TIMESTAMP) continue;
      const double time = mrpt::Clock::toDouble(observation->timestamp);
      newest = isFirst ? time : std::max(newest, time);
      isFirst = false;
    }
    return newest;
  }

  double rate_;
  const StopCheck& stop_;
  Clock::time_point start_{};
  double first_ = 0, last_ = 0;
  size_t count_ = 0;
};

}  // namespace

RawlogPlayer::RawlogPlayer(const std::string& file, double cycleRate, double replayRate,
                           const StopCheck& stop)
    : file_(file), cycleRate_(cycleRate), replayRate_(replayRate) {
  const readings::RawlogSummary log = readings::summarise(file, {}, stop);
  warnings_ = readings::warningsOf(log, file);
  state_ = log.state;
  hasOdometryReadings_ = log.hasOdometryReadings;
  if (!log.defect.empty()) {
    defect_ = "log " + log.defect + ": " + log.defectPlace(file) + "; served up to this point";
    warnings_.push_back(defect_);
  }
}

void RawlogPlayer::run(const CycleSink& sink, const StopCheck& stop) {
  Pace pace(replayRate_, stop);
  CycleGrouper grouper(cycleRate_, [&](const CSensoryFrame::Ptr& cycle) {
    pace.wait(*cycle);
    if (!stop()) sink(cycle);
  });
  readings::LogReader reader(file_);
  mrpt::math::TPose2D travelled;
  bool hasActions = false;
  while (const auto object = stop() ? nullptr : reader.next()) {
    if (const auto increment = hasOdometryReadings_ ? std::nullopt : readings::incrementOf(object)) {
      if (readings::isFinite(*increment) && !readings::isJump({}, *increment))
        travelled = travelled + *increment;
      hasActions = true;
    }
    readings::forEachObservation(object, [&](const CObservation::Ptr& observation) {
      if (hasActions && std::dynamic_pointer_cast<mrpt::obs::CObservation2DRangeScan>(observation)) {
        auto odometry = mrpt::obs::CObservationOdometry::Create();
        odometry->sensorLabel = "ODOMETRY";
        odometry->timestamp = observation->timestamp;
        odometry->odometry = mrpt::poses::CPose2D(travelled);
        grouper.add(odometry);
      }
      grouper.add(observation);
    });
  }
  grouper.finish();
  if (!stop() && files::stateOf(file_) != state_)
    throw std::runtime_error("log has changed while it was served: " + std::string(reader.unit()) + " " +
                             std::to_string(reader.entry()) + " of " + file_ + "; served up to this point");
  if (!stop() && !defect_.empty()) throw std::runtime_error(defect_);
}

}  // namespace hybrid_slam::live
