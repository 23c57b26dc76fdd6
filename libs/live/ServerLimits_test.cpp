/// What strangers and floods of connections cost an observation-server.
#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <thread>

#include "live/ObservationServer.h"
#include "testing/TestEvents.h"

namespace hybrid_slam::live {
namespace {

const std::string kHere = "127.0.0.1";

struct ServerLimits : testing::Test {
  test::Events events;
  ObservationServer::Limits limits;
};

TEST_F(ServerLimits, AClientThatSendsWithoutEndIsDisconnected) {
  const ObservationServer server(kHere, 0, limits, events.log());
  TcpSocket chatty = TcpSocket::connectTo(kHere, server.port(), 10);
  EXPECT_THROW(
      {
        for (int i = 0; i < 1000; ++i) chatty.send(std::string(65536, 'x'), 30);
      },
      std::runtime_error);
  EXPECT_TRUE(test::happens([&] { return events.count("sent over 1 MiB") == 1; })) << events.text();
}

TEST_F(ServerLimits, NewClientsBeyondTheRateWait) {
  limits.clients = 3;
  limits.newPerSecond = 0;
  ObservationServer server(kHere, 0, limits, events.log());
  for (size_t i = 1; i <= 3; ++i) {
    const TcpSocket brief = TcpSocket::connectTo(kHere, server.port(), 10);
    ASSERT_TRUE(test::happens([&] { return events.count(": connected") == i; })) << events.text();
  }
  ASSERT_TRUE(test::happens([&] { return server.clients() == 0; }));
  const TcpSocket waiting = TcpSocket::connectTo(kHere, server.port(), 10);
  for (int i = 0; i < 20; ++i) {
    server.publish({});  // wakes the server
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_EQ(events.count(": connected"), 3u);
}

TEST_F(ServerLimits, WaitingClientsAreServedLater) {
  limits.clients = 3;
  limits.newPerSecond = 100;
  const ObservationServer server(kHere, 0, limits, events.log());
  for (size_t i = 1; i <= 6; ++i) {
    const TcpSocket brief = TcpSocket::connectTo(kHere, server.port(), 10);
    ASSERT_TRUE(test::happens([&] { return events.count(": connected") == i; })) << events.text();
  }
}

TEST_F(ServerLimits, AWrongTokenThatIsTriedAgainIsReportedOnce) {
  limits.token = "0123456789abcdef";
  const ObservationServer server(kHere, 0, limits, events.log());
  for (int i = 0; i < 3; ++i) {
    TcpSocket stranger = TcpSocket::connectTo(kHere, server.port(), 10);
    stranger.send("0123456789abcdeF\n", 10);
    EXPECT_THROW(for (;;) stranger.receive(10), std::runtime_error);
  }
  EXPECT_EQ(events.count("wrong token"), 1u) << events.text();
  EXPECT_EQ(events.count(": connected"), 0u) << events.text();
}

TEST_F(ServerLimits, AClientWithoutATokenLeavesItsPlaceToOthers) {
  limits.token = "0123456789abcdef";
  limits.clients = 1;
  limits.newPerSecond = 100;
  limits.tokenPatience = 0.2;
  const ObservationServer server(kHere, 0, limits, events.log());
  const TcpSocket silent = TcpSocket::connectTo(kHere, server.port(), 10);
  TcpSocket known = TcpSocket::connectTo(kHere, server.port(), 10);
  known.send(limits.token + "\n", 10);
  EXPECT_TRUE(test::happens([&] { return events.count(": connected") == 1; })) << events.text();
  EXPECT_EQ(events.count("no token"), 1u) << events.text();
}

}  // namespace
}  // namespace hybrid_slam::live
