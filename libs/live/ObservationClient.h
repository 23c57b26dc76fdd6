/// @file ObservationClient.h
/// @brief Receives cycles from an observation-server and reconnects after faults.
#pragma once

#include <atomic>
#include <string>

#include "live/CycleSource.h"
#include "live/EventLog.h"
#include "live/OdometryContinuity.h"

namespace hybrid_slam::live {

struct Message;

/// The client's side of a connection.
class ObservationClient : public CycleSource {
 public:
  /// Where the server is, and how long to wait for it.
  struct Settings {
    std::string host = "127.0.0.1";
    uint16_t port = 0;
    double timeout = 5;   ///< s without a whole message; an idle server sends a heartbeat every second
    std::string token{};  ///< sent first; empty: none
  };

  ObservationClient(const Settings& settings, EventLog& log) : settings_(settings), log_(log) {}

  /// Reconnects, with pauses of 0.1 s growing to 2 s, if the connection breaks, falls silent or violates the
  /// protocol. Ends when the server reports the end of its log. If a new server answers, whose odometry
  /// restarts, odometry continues from the last pose.
  void run(const CycleSink& sink, const StopCheck& stop) override;

  size_t lost() const { return lost_; }                ///< cycles sent by the server but not received
  size_t attempts() const { return attempts_; }        ///< to connect, so far
  size_t connections() const { return connections_; }  ///< so far
  bool isConnected() const { return isConnected_; }    ///< now: the server's first message has arrived
  bool hasEnded() const { return hasEnded_; }          ///< the server reported its end

 private:
  void listen(const CycleSink& sink, const StopCheck& stop);
  void take(const Message& message, const CycleSink& sink);

  Settings settings_;
  EventLog& log_;
  std::atomic<size_t> lost_{0}, attempts_{0}, connections_{0};
  std::atomic<bool> hasEnded_{false}, isConnected_{false};
  uint64_t session_ = 0, number_ = 0;
  bool hasSession_ = false;
  double pause_ = 0;  ///< s
  OdometryContinuity odometry_;
};

}  // namespace hybrid_slam::live
