/// @file ServeObservations.h
/// @brief observation-server: sensors or a rawlog to TCP clients.
#pragma once

#include <mrpt/config/CConfigFileMemory.h>

#include <functional>
#include <memory>
#include <string>

#include "live/CycleSource.h"
#include "live/EventLog.h"
#include "live/LiveOptions.h"

namespace hybrid_slam::sensors {

/// Serves until it is to stop, or the log that is replayed has ended and the clients have taken it all.
/// @param config   with a section for each sensor, where options name no rawlog
/// @param isReady  called with the port once clients can connect
/// @return one line: what was served
/// @throws InputError for wrong sensors, a wrong rawlog, an address where it cannot listen
std::string serveObservations(const live::ServerOptions& options,
                              const mrpt::config::CConfigFileMemory& config,
                              const std::shared_ptr<live::EventLog>& log, const live::StopCheck& stop,
                              const std::function<void(uint16_t)>& isReady);

}  // namespace hybrid_slam::sensors
