/// @file ListeningClient.h
/// @brief For the tests: clients of an observation-server on this machine, and cycles for them.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "live/ObservationClient.h"
#include "live/ObservationServer.h"
#include "testing/TestEvents.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::test {

inline const std::string kThisMachine = "127.0.0.1";
inline live::ObservationServer::Limits limits(size_t queue = 1000, size_t clients = 250) {
  return {queue, clients, 30, ""};
}

inline mrpt::obs::CSensoryFrame cycle(double time, double x = 0, size_t beams = 181) {
  mrpt::obs::CSensoryFrame frame;
  frame.insert(odometry(time, {x, 0, 0}));
  frame.insert(scan(time, {}, beams));
  return frame;
}

/// A client in a separate thread, with its received cycles.
class Listener {
 public:
  Listener(uint16_t port, Events& events, double timeout = 30, const std::string& token = "")
      : client_({kThisMachine, port, timeout, token}, events.log()), thread_([this] {
          client_.run([this](const mrpt::obs::CSensoryFrame::Ptr& frame) { take(*frame); },
                      [this] { return stop_.load(); });
          hasReturned_ = true;
        }) {}
  ~Listener() {
    stop_ = true;
    thread_.join();
  }
  size_t count() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return odometry_.size();
  }
  std::vector<double> odometry() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return odometry_;
  }
  bool hasReturned() const { return hasReturned_; }
  const live::ObservationClient& client() const { return client_; }

 private:
  void take(const mrpt::obs::CSensoryFrame& frame) {
    const auto odometry = frame.getObservationByClass<mrpt::obs::CObservationOdometry>();
    const std::lock_guard<std::mutex> lock(mutex_);
    odometry_.push_back(odometry->odometry.x());
  }
  std::atomic<bool> stop_{false}, hasReturned_{false};
  mutable std::mutex mutex_;
  std::vector<double> odometry_;
  live::ObservationClient client_;
  std::thread thread_;
};

}  // namespace hybrid_slam::test
