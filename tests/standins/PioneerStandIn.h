/// @file PioneerStandIn.h
/// @brief A Pioneer on TCP: the ARCOS handshake, ten (or more) server information packets a second, a
/// watchdog.
#pragma once

#include <chrono>
#include <mutex>
#include <set>

#include "live/ArcosPacket.h"
#include "standins/SimulatedRobot.h"
#include "standins/StandIn.h"

namespace hybrid_slam::test {

class PioneerStandIn : public StandIn {
 public:
  /// @param rate  SIPs/s
  PioneerStandIn(const SimulatedRobot& robot, double rate, uint16_t port = 0)
      : StandIn(port), robot_(robot), period_(std::chrono::duration<double>(1 / rate)) {
    start();
  }
  ~PioneerStandIn() override { join(); }

  /// Numbers of all commands since the last OPEN.
  std::set<int> commands() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return commands_;
  }
  size_t pulses() const { return pulses_; }
  size_t closes() const { return closes_; }

 private:
  using Clock = std::chrono::steady_clock;

  void connected() override;
  void step(live::TcpSocket& socket, const std::string& bytes) override;
  void obey(live::TcpSocket& socket, const live::arcos::Payload& command);
  live::arcos::Payload sip() const;

  const SimulatedRobot& robot_;
  std::chrono::duration<double> period_;
  live::arcos::Decoder decoder_;
  int synced_ = 0;  ///< steps of the handshake done
  bool isOpen_ = false;
  mrpt::math::TPose2D start_;  ///< pose at which the counters were last zero
  Clock::time_point lastSip_{};
  mutable std::mutex mutex_;
  std::set<int> commands_;
  std::atomic<size_t> pulses_{0}, closes_{0};
};

}  // namespace hybrid_slam::test
