#include "live/LiveOptions.h"

#include <regex>

#include "base/Errors.h"

namespace hybrid_slam::live {

void LiveOptions::describe(OptionTable& t) {
  t.add("server", server,
        "HOST:PORT of an observation-server, IPv6 address in brackets; empty: use the sensors of this file");
  t.add("token_file", tokenFile, "file whose first line is the token of that server; empty: none");
  t.add("timeout", timeout, 1.5, 3600, "s",
        "reconnect after this long without data; the server sends a heartbeat every second");
  t.add("cycle_rate", cycleRate, 0, 1000, "1/s", "cycle rate of this file's sensors; 0: one cycle per scan");
  t.add("sensor_timeout", sensorTimeout, 0.1, 3600, "s",
        "restart a sensor of this file after this long without data");
  t.add("max_waiting", maxWaiting, 1, 100000,
        "largest number of scans waiting for the filter; beyond it all but the newest are skipped, their "
        "motion is kept");
  t.add("recording", recording,
        "file name of the rawlog of raw observations, in the results folder; the date and time are added");
  t.add("disk_reserve", diskReserve, 0, 1e9, "MB",
        "free disk space below which the recording stops, so that the results find space; the run continues");
}

void ServerOptions::describe(OptionTable& t) {
  t.add("address", address,
        "local address to listen on, numeric or localhost; all interfaces: 0.0.0.0 (IPv4) or ::, with a "
        "token only");
  t.add("token_file", tokenFile,
        "file whose first line, of 16 to 256 characters, clients must send; empty: none");
  t.add("port", port, 0, 65535, "TCP port; 0: any free port, printed on standard output");
  t.add("cycle_rate", cycleRate, 0, 1000, "1/s",
        "cycle rate; each laser gives at most one scan per cycle; 0: one cycle per scan");
  t.add("sensor_timeout", sensorTimeout, 0.1, 3600, "s", "restart a sensor after this long without data");
  t.add("queue", queue, 1, 1000000,
        "cycles queued per client; when the queue is full, the oldest is dropped");
  t.add("max_clients", maxClients, 1, 10000, "simultaneous clients; others wait until one disconnects");
  t.add("rawlog", rawlog, "log to replay instead of reading sensors");
  t.add("replay_rate", replayRate, 0, 1000000, "1/s", "cycle rate of the replay; 0: the log's own pace");
  t.add("wait_for_clients", waitForClients, 0, 10000,
        "clients that must be connected before the replay starts");
}

std::pair<std::string, uint16_t> hostAndPort(const std::string& text, const std::string& where) {
  static const std::regex form(R"((?:\[([^\]]+)\]|([^:\[\]]+)):(\d{1,5}))");  // IPv6 address in brackets
  std::smatch parts;
  constexpr size_t kLongest = 300;  // std::regex overflows the stack on long texts
  const bool matches = text.size() <= kLongest && std::regex_match(text, parts, form);
  const int port = matches ? std::stoi(parts[3]) : 0;
  if (port < 1 || port > 65535)
    throw InputError("wrong server `" + text.substr(0, kLongest) + "`", where,
                     "expected HOST:PORT, such as robot:4550 or [::1]:4550");
  return {parts[1].matched ? parts[1] : parts[2], static_cast<uint16_t>(port)};
}

}  // namespace hybrid_slam::live
