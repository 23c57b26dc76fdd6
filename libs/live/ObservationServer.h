/// @file ObservationServer.h
/// @brief Serves cycles to any number of clients; a slow client blocks neither the robot nor other clients.
#pragma once

#include <mrpt/obs/CSensoryFrame.h>

#include <atomic>
#include <chrono>
#include <deque>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "live/EventLog.h"
#include "live/ObservationWire.h"
#include "live/TcpSocket.h"

namespace hybrid_slam::live {

/// One thread serves all clients without blocking. Each has a queue of unsent cycles; when it is full, the
/// oldest cycle is dropped. A client that reads nothing for too long is disconnected, because it
/// occupies a place that another may need. So is one that sends over 1 MiB.
class ObservationServer {
 public:
  /// What a client may cost the server.
  struct Limits {
    size_t queue = 50;  ///< cycles queued per client
    size_t clients = 250;
    double patience = 30;  ///< s for a client to read a message, before it is disconnected
    std::string token{};   ///< a client gets nothing before it has sent this and a line end; empty: no token
    double newPerSecond = 10;  ///< clients, after as many at once as `clients`; the others wait
    double tokenPatience = 5;  ///< s for a client to send the token, before it is disconnected
  };

  /// @param address  local address to listen on; @param port  0: any free port
  /// @throws InputError if it cannot listen, or other machines could connect without a token
  ObservationServer(const std::string& address, uint16_t port, Limits limits, EventLog& log);
  ~ObservationServer();
  ObservationServer(const ObservationServer&) = delete;
  ObservationServer& operator=(const ObservationServer&) = delete;

  uint16_t port() const { return listener_.port(); }
  size_t clients() const { return clientCount_; }
  size_t cycles() const { return number_; }
  size_t dropped() const { return dropped_; }  ///< cycles, over all clients

  /// Puts the cycle into every client's queue; takes microseconds. From any thread.
  void publish(const mrpt::obs::CSensoryFrame& cycle);
  /// Signals the end to the clients and waits at most `timeout` s for them to receive all.
  void finish(double timeout);

 private:
  /// An encoded message.
  struct Encoded {
    MessageKind kind;
    std::string bytes;
  };
  struct Client {
    TcpSocket socket;
    std::string name;
    bool isKnown = false;                               ///< no token needed, or it was received
    size_t received = 0;                                ///< bytes
    std::string shown;                                  ///< part of the token received so far
    std::deque<std::shared_ptr<const Encoded>> queue;   ///< the first may be partly sent
    size_t sent = 0;                                    ///< bytes of the first
    size_t dropped = 0;                                 ///< cycles since the queue was last empty
    std::chrono::steady_clock::time_point lastTaken{};  ///< a message, or the queue was empty
  };

  void serve();
  bool isOpenToClients();
  void accept();
  void becomeKnown(Client& client);
  void read(Client& client);
  void write(Client& client);
  void enqueue(MessageKind kind, std::string payload = {});
  void wake() const;

  Limits limits_;
  EventLog& log_;
  TcpListener listener_;
  int wakeUp_ = -1;  ///< eventfd
  const uint64_t session_;
  std::atomic<uint64_t> number_{0};
  std::atomic<size_t> clientCount_{0}, dropped_{0};
  std::atomic<bool> stop_{false};
  /// Guards the clients' queues, number_ and lastMessage_; only the thread adds and removes clients.
  std::mutex mutex_;
  std::chrono::steady_clock::time_point lastMessage_ = std::chrono::steady_clock::now();
  std::list<Client> clients_;
  double allowed_;  ///< new clients now
  std::chrono::steady_clock::time_point lastAllowed_ = std::chrono::steady_clock::now();
  std::thread thread_;
};

}  // namespace hybrid_slam::live
