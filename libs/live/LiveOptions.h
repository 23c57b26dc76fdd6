/// @file LiveOptions.h
/// @brief INI sections [live] and [server].
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "base/Options.h"

namespace hybrid_slam::live {

/// Section [live] of hybrid-slam-live.
struct LiveOptions : Options {
  std::string server, tokenFile;
  double timeout = 5;        ///< s
  double cycleRate = 5;      ///< 1/s
  double sensorTimeout = 5;  ///< s
  int maxWaiting = 5;        ///< scans
  std::string recording = "recording.rawlog";
  double diskReserve = 1000;  ///< MB
  void describe(OptionTable& table) override;
};

/// Section [server] of observation-server.
struct ServerOptions : Options {
  std::string address = "127.0.0.1", tokenFile;
  int port = 4550;
  double cycleRate = 5;      ///< 1/s
  double sensorTimeout = 5;  ///< s
  int queue = 50;            ///< cycles
  int maxClients = 250;
  std::string rawlog;
  double replayRate = 0;  ///< 1/s
  int waitForClients = 0;
  void describe(OptionTable& table) override;
};

/// Splits "HOST:PORT". @throws InputError for anything else
std::pair<std::string, uint16_t> hostAndPort(const std::string& text, const std::string& where);

}  // namespace hybrid_slam::live
