#include "sensors/ServeObservations.h"

#include <chrono>
#include <thread>

#include "live/ObservationServer.h"
#include "live/RawlogPlayer.h"
#include "live/Token.h"
#include "sensors/SensorSource.h"

namespace hybrid_slam::sensors {

std::string serveObservations(const live::ServerOptions& options,
                              const mrpt::config::CConfigFileMemory& config,
                              const std::shared_ptr<live::EventLog>& log, const live::StopCheck& stop,
                              const std::function<void(uint16_t)>& isReady) {
  const bool isReplay = !options.rawlog.empty();
  std::unique_ptr<live::CycleSource> source;
  if (isReplay) {
    auto player =
        std::make_unique<live::RawlogPlayer>(options.rawlog, options.cycleRate, options.replayRate, stop);
    for (const std::string& warning : player->warnings()) log->report("rawlog", warning);
    source = std::move(player);
  } else {
    source = std::make_unique<SensorSource>(config, options.cycleRate, options.sensorTimeout, log);
  }

  live::ObservationServer::Limits limits{static_cast<size_t>(options.queue),
                                         static_cast<size_t>(options.maxClients)};
  limits.token = live::readToken(options.tokenFile, "section [server], key `token_file`");
  live::ObservationServer server(options.address, static_cast<uint16_t>(options.port), limits, *log);
  isReady(server.port());
  while (isReplay && !stop() && server.clients() < static_cast<size_t>(options.waitForClients))
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  try {
    source->run([&](const mrpt::obs::CSensoryFrame::Ptr& cycle) { server.publish(*cycle); }, stop);
  } catch (...) {
    server.finish(10);  // the clients get what was read
    throw;
  }
  if (isReplay && !stop()) server.finish(10);
  return std::to_string(server.cycles()) + " cycles served, " + std::to_string(server.dropped()) +
         " dropped for slow clients";
}

}  // namespace hybrid_slam::sensors
