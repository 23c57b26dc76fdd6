/// @file ObservationClient.h
/// @brief The cycles of an observation-server, whatever happens to the connection.
#pragma once

#include <atomic>
#include <string>

#include "live/CycleSource.h"
#include "live/EventLog.h"
#include "live/OdometryContinuity.h"

namespace hybrid_slam::live {

struct Message;

class ObservationClient : public CycleSource {
 public:
  struct Settings {
    std::string host = "127.0.0.1";
    uint16_t port = 0;
    double timeout = 5;  ///< s; a server that has nothing to say beats every second
  };

  ObservationClient(const Settings& settings, EventLog& log) : settings_(settings), log_(log) {}

  /// Connects again, with pauses of 0.1 s growing to 2 s, when the connection breaks, falls silent or brings
  /// bytes that are not the protocol's. Ends when the server says that its log has ended. Where another
  /// server answers, whose odometry starts anew, it goes on from the last pose.
  void run(const CycleSink& sink, const StopCheck& stop) override;

  size_t lost() const { return lost_; }                ///< cycles that the server made but that did not come
  size_t connections() const { return connections_; }  ///< so far
  bool hasEnded() const { return hasEnded_; }          ///< the server said so

 private:
  void listen(const CycleSink& sink, const StopCheck& stop);
  void take(const Message& message, const CycleSink& sink);

  Settings settings_;
  EventLog& log_;
  std::atomic<size_t> lost_{0}, connections_{0};
  std::atomic<bool> hasEnded_{false};
  uint64_t session_ = 0, number_ = 0;
  bool hasSession_ = false;
  double pause_ = 0;  ///< s
  OdometryContinuity odometry_;
};

}  // namespace hybrid_slam::live
