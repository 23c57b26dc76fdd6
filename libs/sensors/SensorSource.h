/// @file SensorSource.h
/// @brief All sensors of an INI file as one cycle source.
#pragma once

#include <mrpt/config/CConfigFileMemory.h>

#include <memory>
#include <string>
#include <vector>

#include "live/CycleSource.h"
#include "sensors/SensorThread.h"

namespace hybrid_slam::sensors {

/// Each sensor runs in its own thread.
class SensorSource : public live::CycleSource {
 public:
  /// Every section with a `driver` is a sensor, unless it has `rawlog-grabber-ignore = true`.
  /// @param cycleRate  1/s; @param timeout  s without data until a sensor is restarted
  /// @throws InputError if there is no sensor, or a wrong one
  SensorSource(const mrpt::config::CConfigFileMemory& config, double cycleRate, double timeout,
               const std::shared_ptr<live::EventLog>& log);

  void run(const live::CycleSink& sink, const live::StopCheck& stop) override;

 private:
  double cycleRate_;
  std::shared_ptr<ObservationInbox> inbox_ = std::make_shared<ObservationInbox>();
  std::vector<std::unique_ptr<SensorThread>> sensors_;
};

}  // namespace hybrid_slam::sensors
