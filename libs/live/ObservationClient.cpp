#include "live/ObservationClient.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "base/Clock.h"
#include "base/Errors.h"
#include "live/ObservationWire.h"
#include "live/TcpSocket.h"

namespace hybrid_slam::live {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double kShortestPause = 0.1, kLongestPause = 2;  // s
constexpr uint64_t kMostLost = 1'000'000'000'000;          // a server may send any number

}  // namespace

void ObservationClient::run(const CycleSink& sink, const StopCheck& stop) {
  const std::string subject = "server " + addressText(settings_.host, settings_.port);
  pause_ = kShortestPause;
  while (!stop() && !hasEnded_) {
    std::string fault;
    try {
      listen(sink, stop);
    } catch (const WireError& e) {
      fault = std::string("sent ") + e.what();
    } catch (const InputError&) {
      throw;  // from the sink
    } catch (const std::runtime_error& e) {
      fault = messageOf(e);
    }
    isConnected_ = false;
    if (fault.empty()) continue;
    log_.report(subject, fault + "; trying again");
    const auto start = Clock::now();
    while (!stop() && secondsSince(start) < pause_)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    pause_ = std::min(2 * pause_, kLongestPause);
  }
}

void ObservationClient::listen(const CycleSink& sink, const StopCheck& stop) {
  ++attempts_;
  TcpSocket socket = TcpSocket::connectTo(settings_.host, settings_.port, settings_.timeout, stop);
  if (!socket.isOpen()) return;
  if (!settings_.token.empty()) socket.send(settings_.token + '\n', settings_.timeout);
  ++connections_;
  MessageDecoder decoder;
  auto lastMessage = Clock::now();
  bool isFirst = true;
  while (!stop() && !hasEnded_) {
    // Whole messages count: single bytes may come forever.
    if (secondsSince(lastMessage) > settings_.timeout)
      throw std::runtime_error("silent for " + std::to_string(static_cast<int>(settings_.timeout)) + " s");
    decoder.feed(socket.receive(0.1));
    while (const auto message = decoder.next()) {
      lastMessage = Clock::now();
      take(*message, sink);
      if (isFirst) log_.report("server " + addressText(settings_.host, settings_.port), "connected");
      if (message->kind == MessageKind::cycle)
        pause_ = kShortestPause;  // not for a server that sends nonsense
      isFirst = false;
      isConnected_ = true;
      if (hasEnded_) return;
    }
  }
}

void ObservationClient::take(const Message& message, const CycleSink& sink) {
  const auto cycle = message.kind == MessageKind::cycle ? deserialise(message.payload) : nullptr;
  if (hasSession_ && message.session != session_) {
    odometry_.restart();
    log_.report("odometry", "new server: odometry continues from the last pose");
  } else if (hasSession_) {
    const uint64_t expected = number_ + (cycle ? 1 : 0);
    if (message.number > expected)
      lost_ = std::min(kMostLost, lost_ + std::min(kMostLost, message.number - expected));
  }
  hasSession_ = true;
  session_ = message.session, number_ = message.number;
  hasEnded_ = message.kind == MessageKind::end;
  if (!cycle) return;
  for (const auto& observation : *cycle) rebase(*observation, odometry_);
  sink(cycle);
}

}  // namespace hybrid_slam::live
