/// A server and its clients over loopback.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <thread>

#include "base/Clock.h"
#include "base/Errors.h"
#include "testing/ListeningClient.h"

namespace hybrid_slam::live {
namespace {

using test::cycle;
using test::kThisMachine;
using test::limits;
using test::Listener;

TEST(Connection, EveryClientGetsEveryCycleUntilTheEnd) {
  test::Events events;
  ObservationServer server(kThisMachine, 0, limits(), events.log());
  Listener a(server.port(), events), b(server.port(), events);
  ASSERT_TRUE(test::happens([&] { return server.clients() == 2; }));
  for (int i = 0; i < 200; ++i) server.publish(cycle(10 + i, i));
  server.finish(30);
  ASSERT_TRUE(test::happens([&] { return a.hasReturned() && b.hasReturned(); }));
  for (const Listener* listener : {&a, &b}) {
    ASSERT_EQ(listener->count(), 200u);
    for (int i = 0; i < 200; ++i) EXPECT_EQ(listener->odometry()[static_cast<size_t>(i)], i);
    EXPECT_EQ(listener->client().lost(), 0u);
    EXPECT_EQ(listener->client().connections(), 1u);
    EXPECT_TRUE(listener->client().hasEnded());
  }
  EXPECT_EQ(server.dropped(), 0u);
}

/// Heartbeats and cycles come from different threads, but must arrive in the order of their numbers.
TEST(Connection, CyclesOfSeveralThreadsAreInOrder) {
  test::Events events;
  ObservationServer server(kThisMachine, 0, limits(10000), events.log());
  Listener listener(server.port(), events);
  ASSERT_TRUE(test::happens([&] { return server.clients() == 1; }));
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      for (int k = 0; k < 500; ++k) server.publish(cycle(10));
    });
  for (std::thread& thread : threads) thread.join();
  server.finish(30);
  ASSERT_TRUE(test::happens([&] { return listener.hasReturned(); }));
  EXPECT_EQ(listener.count(), 2000u);
  EXPECT_EQ(listener.client().lost(), 0u);
}

TEST(Connection, AClientThatDoesNotReadLosesOldCyclesAndBlocksNoOne) {
  test::Events events;
  ObservationServer server(kThisMachine, 0, limits(20), events.log());
  TcpSocket lazy = TcpSocket::connectTo(kThisMachine, server.port(), 10);
  Listener busy(server.port(), events);
  ASSERT_TRUE(test::happens([&] { return server.clients() == 2; }));
  size_t sent = 0;
  // The system's socket buffers first absorb some megabytes.
  while (server.dropped() < 50 && sent < 20000) {
    server.publish(cycle(10, static_cast<double>(sent++), 10000));
    ASSERT_TRUE(test::happens([&] { return busy.count() == sent; })) << "the other client gets all";
  }
  EXPECT_GE(server.dropped(), 50u);
  EXPECT_EQ(events.count("too slow"), 1u) << events.text();
  EXPECT_EQ(busy.client().lost(), 0u);

  // It reads again: the cycles are complete, in order, and end with the newest.
  MessageDecoder decoder;
  uint64_t last = 0;
  size_t lost = 0;
  ASSERT_TRUE(test::happens([&] {
    decoder.feed(lazy.receive(0.01));
    while (const auto message = decoder.next()) {
      if (message->kind != MessageKind::cycle) continue;
      EXPECT_GT(message->number, last);
      lost += message->number - last - 1;
      last = message->number;
    }
    return last == sent;
  }));
  EXPECT_EQ(lost, server.dropped());
  EXPECT_TRUE(test::happens([&] { return events.count("keeps up again") == 1; }));
}

TEST(Connection, HeartbeatsAndTheEndReplaceNoCycle) {
  test::Events events;
  ObservationServer server(kThisMachine, 0, limits(20), events.log());
  TcpSocket lazy = TcpSocket::connectTo(kThisMachine, server.port(), 10);
  ASSERT_TRUE(test::happens([&] { return server.clients() == 1; }));
  for (size_t i = 0; server.dropped() < 50 && i < 20000; ++i) {
    server.publish(cycle(10, 0, 10000));
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  const size_t dropped = server.dropped(), published = server.cycles();
  ASSERT_GE(dropped, 50u);
  std::this_thread::sleep_for(std::chrono::milliseconds(2500));  // heartbeats are due
  server.finish(0);
  EXPECT_EQ(server.dropped(), dropped);

  MessageDecoder decoder;
  size_t received = 0;
  ASSERT_TRUE(test::happens([&] {
    decoder.feed(lazy.receive(0.01));
    while (const auto message = decoder.next()) {
      if (message->kind == MessageKind::end) return true;
      received += message->kind == MessageKind::cycle;
    }
    return false;
  }));
  EXPECT_EQ(received, published - dropped);
}

TEST(Connection, AHundredSilentClientsBlockNoOne) {
  test::Events events;
  ObservationServer server(kThisMachine, 0, limits(), events.log());
  std::vector<TcpSocket> silent;
  for (int i = 0; i < 100; ++i) silent.push_back(TcpSocket::connectTo(kThisMachine, server.port(), 30));
  Listener listener(server.port(), events);
  ASSERT_TRUE(test::happens([&] { return server.clients() == 101; }));
  for (int i = 0; i < 20; ++i) server.publish(cycle(10 + i));
  EXPECT_TRUE(test::happens([&] { return listener.count() == 20; }));
  silent.clear();
  EXPECT_TRUE(test::happens([&] { return server.clients() == 1; }));
  server.publish(cycle(50));
  EXPECT_TRUE(test::happens([&] { return listener.count() == 21; }));
}

TEST(Connection, SurplusClientsWaitUntilOneLeaves) {
  test::Events events;
  ObservationServer server(kThisMachine, 0, limits(10, 2), events.log());
  auto first = std::make_unique<Listener>(server.port(), events);
  Listener second(server.port(), events);
  ASSERT_TRUE(test::happens([&] { return server.clients() == 2; }));
  Listener third(server.port(), events);
  server.publish(cycle(1));
  ASSERT_TRUE(test::happens([&] { return first->count() == 1 && second.count() == 1; }));
  EXPECT_EQ(third.count(), 0u);
  first.reset();
  EXPECT_TRUE(test::happens([&] {
    server.publish(cycle(2));
    return third.count() > 0;
  }));
}

TEST(Connection, BytesFromClientsAreDiscarded) {
  test::Events events;
  ObservationServer server(kThisMachine, 0, limits(), events.log());
  TcpSocket chatty = TcpSocket::connectTo(kThisMachine, server.port(), 10);
  Listener listener(server.port(), events);
  ASSERT_TRUE(test::happens([&] { return server.clients() == 2; }));
  for (int i = 0; i < 16; ++i) chatty.send(std::string(65536, 'x'), 30);
  server.publish(cycle(1));
  EXPECT_TRUE(test::happens([&] { return listener.count() == 1; }));
}

TEST(Connection, AClientThatTakesNothingLeavesItsPlaceToOthers) {
  test::Events events;
  ObservationServer server(kThisMachine, 0, {20, 1, 0.3, ""}, events.log());
  const TcpSocket stuck = TcpSocket::connectTo(kThisMachine, server.port(), 10);
  ASSERT_TRUE(test::happens([&] { return server.clients() == 1; }));
  Listener good(server.port(), events);
  EXPECT_TRUE(test::happens([&] {
    server.publish(cycle(10, 1, 10000));
    return good.count() > 0;
  })) << events.text();
  EXPECT_EQ(events.count("does not read"), 1u) << events.text();
}

TEST(Connection, AnIdleServerSendsHeartbeats) {
  test::Events events;
  ObservationServer server(kThisMachine, 0, limits(), events.log());
  TcpSocket socket = TcpSocket::connectTo(kThisMachine, server.port(), 10);
  MessageDecoder decoder;
  std::optional<Message> message;
  ASSERT_TRUE(test::happens([&] {
    decoder.feed(socket.receive(0.1));
    message = decoder.next();
    return message.has_value();
  }));
  EXPECT_EQ(message->kind, MessageKind::heartbeat);
}

TEST(Connection, AHeartbeatFollowsACycleWithinASecond) {
  test::Events events;
  ObservationServer server(kThisMachine, 0, limits(), events.log());
  TcpSocket socket = TcpSocket::connectTo(kThisMachine, server.port(), 10);
  MessageDecoder decoder;
  const auto waitForHeartbeat = [&] {
    EXPECT_TRUE(test::happens([&] {
      decoder.feed(socket.receive(0.01));
      while (const auto message = decoder.next())
        if (message->kind == MessageKind::heartbeat) return true;
      return false;
    }));
  };
  double shortest = 60;  // s; a busy machine may delay some
  for (int i = 0; i < 5 && shortest > 1.5; ++i) {
    waitForHeartbeat();
    server.publish(cycle(10));
    const auto start = std::chrono::steady_clock::now();
    waitForHeartbeat();
    shortest = std::min(shortest, secondsSince(start));
  }
  EXPECT_LT(shortest, 1.5);
}

TEST(Connection, AnAddressItCannotListenOnIsAnError) {
  test::Events events;
  ObservationServer server(kThisMachine, 0, limits(), events.log());
  EXPECT_THROW(ObservationServer(kThisMachine, server.port(), limits(), events.log()), InputError);
  EXPECT_THROW(ObservationServer("203.0.113.1", 0, {20, 10, 30, "0123456789abcdef"}, events.log()),
               InputError);
  EXPECT_THROW(ObservationServer("nowhere", 0, limits(), events.log()), InputError);
}

}  // namespace
}  // namespace hybrid_slam::live
