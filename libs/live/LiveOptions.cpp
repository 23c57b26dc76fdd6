#include "live/LiveOptions.h"

#include <regex>

#include "base/Errors.h"

namespace hybrid_slam {

void LiveOptions::describe(OptionTable& t) {
  t.add("server", server,
        "HOST:PORT of an observation-server, an IPv6 address in brackets; empty: the sensors of this file");
  t.add("timeout", timeout, 1.5, 3600, "s",
        "a server that says nothing for so long is connected to anew; it beats every second");
  t.add("cycle_rate", cycleRate, 0, 1000, "1/s", "of the sensors of this file; 0: every scan is a cycle");
  t.add("sensor_timeout", sensorTimeout, 0.1, 3600, "s",
        "a sensor of this file that gives nothing for so long is started anew");
  t.add("max_waiting", maxWaiting, 1, 1000000,
        "when more scans wait for the filter, all but the newest are skipped; their motion is kept");
  t.add("recording", recording, "name of the rawlog of the raw observations in the folder for the results");
}

void ServerOptions::describe(OptionTable& t) {
  t.add("address", address,
        "of this machine to listen at; all of them: 0.0.0.0 (IPv4) or :: (there is no password)");
  t.add("port", port, 0, 65535, "TCP; 0: one that is free, told on standard output");
  t.add("cycle_rate", cycleRate, 0, 1000, "1/s",
        "cycles; a laser gives at most one scan a cycle; 0: every scan is a cycle");
  t.add("sensor_timeout", sensorTimeout, 0.1, 3600, "s",
        "a sensor that gives nothing for so long is started anew");
  t.add("queue", queue, 1, 1000000, "cycles that wait for one client; when it is full the oldest goes");
  t.add("max_clients", maxClients, 1, 10000, "clients at one time; more wait until one leaves");
  t.add("rawlog", rawlog, "log to replay in place of sensors");
  t.add("replay_rate", replayRate, 0, 1000000, "1/s", "cycles at which the log is replayed; 0: its own pace");
  t.add("wait_for_clients", waitForClients, 0, 10000,
        "clients that must be there before the log is replayed");
}

std::pair<std::string, uint16_t> hostAndPort(const std::string& text, const std::string& where) {
  static const std::regex form(R"((?:\[([^\]]+)\]|([^:\[\]]+)):(\d{1,5}))");  // an IPv6 address in brackets
  std::smatch parts;
  const int port = std::regex_match(text, parts, form) ? std::stoi(parts[3]) : 0;
  if (port < 1 || port > 65535)
    throw InputError("wrong server `" + text + "`", where,
                     "expected HOST:PORT, such as robot:4550 or [::1]:4550");
  return {parts[1].matched ? parts[1] : parts[2], static_cast<uint16_t>(port)};
}

}  // namespace hybrid_slam
