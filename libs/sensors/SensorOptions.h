/// @file SensorOptions.h
/// @brief The keys of a sensor's INI section that are common to our drivers.
#pragma once

#include <string>

#include "base/Options.h"

namespace hybrid_slam::sensors {

/// The keys that MRPT or `SensorThread` read of every sensor.
struct SensorOptions : Options {
  std::string driver, sensorLabel;
  double processRate = 0, timeOffset = 0;
  int maxQueueLength = 200, grabDecimation = 0;
  bool isIgnored = false;

 protected:
  /// @param name    of the driver
  /// @param origin  where its observations come from, and at which rate
  void describeCommon(OptionTable& t, const std::string& name, const std::string& origin) {
    t.add("driver", driver, name);
    t.add("sensorLabel", sensorLabel, "label of the observations");
    t.add("process_rate", processRate, 10, 1000, "1/s", "polling rate of the port; " + origin);
    t.add("max_queue_len", maxQueueLength, 1, 1000000, "MRPT's: maximum number of queued observations");
    t.add("grab_decimation", grabDecimation, 0, 1000000, "MRPT's: keep one observation in this many; 0: all");
    t.add("rawlog-grabber-ignore", isIgnored, "MRPT's: true: ignore this sensor");
    t.add("time_offset", timeOffset, -10, 10, "s", "added to the observations' timestamps");
  }
};

}  // namespace hybrid_slam::sensors
