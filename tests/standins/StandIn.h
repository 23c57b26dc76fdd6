/// @file StandIn.h
/// @brief Common base of the test devices: a TCP server for one client at a time, with faults.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <thread>

#include "live/TcpSocket.h"

namespace hybrid_slam::test {

class StandIn {
 public:
  /// The device's current fault.
  enum class Fault {
    none,
    silent,    ///< connected but no data, as with a pulled cable
    refusing,  ///< closes the current connection and every new one
    garbled,   ///< noise between telegrams, and a wrong checksum where there is one
    cut,       ///< a telegram stops halfway; the rest comes later
  };

  virtual ~StandIn() = default;
  uint16_t port() const { return listener_.port(); }
  void set(Fault fault) { fault_ = fault; }
  size_t connections() const { return connections_; }

 protected:
  explicit StandIn(uint16_t port) : listener_("127.0.0.1", port) {}
  /// A derived class calls this at the end of its constructor, and `join` in its destructor.
  void start() {
    thread_ = std::thread([this] { serve(); });
  }
  void join() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
  }

  virtual void connected() = 0;
  /// Received bytes, possibly none; called repeatedly. Throws if the connection is lost.
  virtual void step(live::TcpSocket& socket, const std::string& bytes) = 0;
  Fault fault() const { return fault_; }

 private:
  void serve() {
    while (!stop_) {
      live::TcpSocket socket = listener_.accept(0.01);
      if (!socket.isOpen() || fault_ == Fault::refusing) continue;
      ++connections_;
      connected();
      try {
        while (!stop_ && fault_ != Fault::refusing) step(socket, socket.receive(0.005));
      } catch (const std::runtime_error&) {  // the client has left
      }
    }
  }

  live::TcpListener listener_;
  std::atomic<Fault> fault_{Fault::none};
  std::atomic<size_t> connections_{0};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace hybrid_slam::test
