#include "sensors/SensorSource.h"

#include "base/Errors.h"
#include "live/CycleGrouper.h"

namespace hybrid_slam::sensors {

SensorSource::SensorSource(const mrpt::config::CConfigFileMemory& config, double cycleRate, double timeout,
                           const std::shared_ptr<live::EventLog>& log)
    : cycleRate_(cycleRate) {
  std::vector<std::string> sections;
  config.getAllSections(sections);
  for (const std::string& section : sections)
    if (config.keyExists(section, "driver") && !config.read_bool(section, "rawlog-grabber-ignore", false))
      sensors_.push_back(std::make_unique<SensorThread>(config, section, timeout, inbox_, log));
  if (sensors_.empty())
    throw InputError("no sensors", "the INI file", "expected a section with `driver = ...` for each sensor");
}

void SensorSource::run(const live::CycleSink& sink, const live::StopCheck& stop) {
  live::CycleGrouper grouper(cycleRate_, sink);
  for (const auto& sensor : sensors_) sensor->start();
  while (!stop())
    for (const auto& observation : inbox_->take(0.1)) grouper.add(observation);
  grouper.finish();
}

}  // namespace hybrid_slam::sensors
