/// @file ServeObservations.h
/// @brief observation-server: serves sensors or a rawlog to TCP clients.
#pragma once

#include <mrpt/config/CConfigFileMemory.h>

#include <functional>
#include <memory>
#include <string>

#include "live/CycleSource.h"
#include "live/EventLog.h"
#include "live/LiveOptions.h"

namespace hybrid_slam::sensors {

/// Serves until stopped, or until the replayed log has ended and the clients have received all of it.
/// @param config   with one section per sensor, unless options name a rawlog
/// @param isReady  called with the port when clients can connect
/// @return a one-line summary
/// @throws InputError for wrong sensors, a wrong rawlog, or an address it cannot listen on;
///         std::runtime_error if stopped while it reads the rawlog for the first time
std::string serveObservations(const live::ServerOptions& options,
                              const mrpt::config::CConfigFileMemory& config,
                              const std::shared_ptr<live::EventLog>& log, const live::StopCheck& stop,
                              const std::function<void(uint16_t)>& isReady);

}  // namespace hybrid_slam::sensors
