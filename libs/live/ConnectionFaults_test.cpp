/// What a client survives: servers that are missing, start again, fall silent or send wrong bytes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <memory>
#include <thread>

#include "files/TemporaryFolder.h"
#include "testing/ListeningClient.h"

namespace hybrid_slam::live {
namespace {

using test::cycle;
using test::kThisMachine;
using test::limits;
using test::Listener;

/// Answers each connection with the bytes of the next script, then closes it or falls silent.
class FakeServer {
 public:
  explicit FakeServer(std::vector<std::string> scripts, bool leaves = true)
      : listener_(kThisMachine, 0), thread_([this, scripts = std::move(scripts), leaves] {
          for (size_t i = 0; !stop_;) {
            TcpSocket socket = listener_.accept(0.02);
            if (!socket.isOpen()) continue;
            socket.send(scripts[std::min(i, scripts.size() - 1)], 10);
            ++i;
            if (!leaves) kept_.push_back(std::move(socket));
          }
        }) {}
  ~FakeServer() {
    stop_ = true;
    thread_.join();
  }
  uint16_t port() const { return listener_.port(); }

 private:
  TcpListener listener_;
  std::atomic<bool> stop_{false};
  std::vector<TcpSocket> kept_;
  std::thread thread_;
};

std::string bytesOf(uint64_t session, uint64_t number, double x) {
  return encode({MessageKind::cycle, session, number, serialise(cycle(10 + x, x))});
}
std::string endOf(uint64_t session, uint64_t number) {
  return encode({MessageKind::end, session, number, {}});
}

TEST(Connection, AMissingServerIsRetriedAndReportedOnce) {
  test::Events events;
  uint16_t port = 0;
  {
    TcpListener reserved(kThisMachine, 0);
    port = reserved.port();
  }
  Listener listener(port, events);
  ASSERT_TRUE(test::happens([&] { return listener.client().attempts() > 2; })) << events.text();
  EXPECT_EQ(events.count("refused"), 1u) << events.text();
  ObservationServer server(kThisMachine, port, limits(), events.log());
  ASSERT_TRUE(test::happens([&] { return server.clients() == 1; }));
  server.publish(cycle(1));
  EXPECT_TRUE(test::happens([&] { return listener.count() == 1; }));
}

TEST(Connection, OdometryContinuesAfterAServerRestart) {
  test::Events events;
  auto server = std::make_unique<ObservationServer>(kThisMachine, 0, limits(), events.log());
  const uint16_t port = server->port();
  Listener listener(port, events);
  ASSERT_TRUE(test::happens([&] { return server->clients() == 1; }));
  server->publish(cycle(1, 5));
  server->publish(cycle(2, 6));
  ASSERT_TRUE(test::happens([&] { return listener.count() == 2; }));
  server.reset();
  server = std::make_unique<ObservationServer>(kThisMachine, port, limits(), events.log());
  ASSERT_TRUE(test::happens([&] { return server->clients() == 1; }));
  server->publish(cycle(3, 0));
  server->publish(cycle(4, 1));
  ASSERT_TRUE(test::happens([&] { return listener.count() == 4; }));
  EXPECT_THAT(listener.odometry(), testing::ElementsAre(5, 6, 6, 7));
  EXPECT_EQ(events.count("continues from the last pose"), 1u);
}

TEST(Connection, CyclesMissedWhileDisconnectedCountAsLost) {
  test::Events events;
  FakeServer server({bytesOf(7, 1, 1), bytesOf(7, 5, 5) + endOf(7, 6)});
  Listener listener(server.port(), events);
  ASSERT_TRUE(test::happens([&] { return listener.hasReturned(); }));
  EXPECT_THAT(listener.odometry(), testing::ElementsAre(1, 5)) << "its odometry was not restarted";
  EXPECT_EQ(listener.client().lost(), 4u) << "2 to 4, and 6";
  EXPECT_EQ(listener.client().connections(), 2u);
}

TEST(Connection, ImpossibleCycleNumbersDoNotOverflowTheCount) {
  test::Events events;
  const uint64_t last = std::numeric_limits<uint64_t>::max();
  FakeServer server(
      {bytesOf(7, 1, 1), bytesOf(7, last, 2), bytesOf(7, 1, 3), bytesOf(7, last, 4) + endOf(7, last)});
  Listener listener(server.port(), events);
  ASSERT_TRUE(test::happens([&] { return listener.hasReturned(); }));
  EXPECT_EQ(listener.client().lost(), 1'000'000'000'000u);
}

/// The first connection sends `wrong` after a valid cycle, the second one the rest.
void expectSurvived(const std::string& wrong, const std::string& report) {
  SCOPED_TRACE(report);
  test::Events events;
  FakeServer server({bytesOf(7, 1, 1) + wrong, bytesOf(7, 2, 2) + endOf(7, 2)});
  Listener listener(server.port(), events);
  ASSERT_TRUE(test::happens([&] { return listener.hasReturned(); }));
  EXPECT_THAT(listener.odometry(), testing::ElementsAre(1, 2));
  EXPECT_EQ(events.count(report), 1u) << events.text();
}

TEST(Connection, WrongBytesEndOnlyTheConnection) {
  expectSurvived("garbage", "bytes that are not a message");
  expectSurvived(std::string(100000, '\0'), "bytes that are not a message");
  expectSurvived(bytesOf(7, 2, 2).substr(0, 100), "closed the connection");

  std::string checksum = bytesOf(7, 2, 9);
  checksum[40] = static_cast<char>(checksum[40] ^ 4);
  expectSurvived(checksum, "wrong checksum");

  std::string length = bytesOf(7, 2, 9);
  for (size_t i = 24; i < 28; ++i) length[i] = '\xff';
  expectSurvived(length, "a message of 4294967295 bytes");

  const files::TemporaryFolder folder;
  const std::string pair =
      test::contentOf(test::writePlain(folder.path("object"), {test::action({1, 0, 0})}));
  expectSurvived(encode({MessageKind::cycle, 7, 2, pair}), "CActionCollection");
  expectSurvived(encode({MessageKind::cycle, 7, 2, "nonsense"}), "unreadable");
}

/// Otherwise it fills the log of messages.
TEST(Connection, AServerThatSendsNoCyclesIsTriedLessAndLessOften) {
  test::Events events;
  const std::string nonsense = encode({MessageKind::heartbeat, 7, 1, ""}) + "garbage";
  FakeServer server({nonsense, nonsense, nonsense, bytesOf(7, 1, 1) + endOf(7, 1)});
  const auto start = std::chrono::steady_clock::now();
  Listener listener(server.port(), events);
  ASSERT_TRUE(test::happens([&] { return listener.hasReturned(); }));
  EXPECT_GT(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(100 + 200 + 400));
}

TEST(Connection, AHalfOpenConnectionIsGivenUp) {
  test::Events events;
  FakeServer server({bytesOf(7, 1, 1), bytesOf(7, 2, 2) + endOf(7, 2)}, false);
  Listener listener(server.port(), events, 0.3);
  ASSERT_TRUE(test::happens([&] { return listener.hasReturned(); }));
  EXPECT_THAT(listener.odometry(), testing::ElementsAre(1, 2));
  EXPECT_EQ(events.count("silent"), 1u) << events.text();
}

TEST(Connection, AServerThatSendsSingleBytesIsGivenUp) {
  test::Events events;
  TcpListener listener(kThisMachine, 0);
  Listener client(listener.port(), events, 0.3);
  TcpSocket socket = listener.accept(10);
  ASSERT_TRUE(socket.isOpen());
  const std::string bytes = encode({MessageKind::cycle, 7, 1, serialise(cycle(10, 1, 10000))});
  size_t sent = 0;
  EXPECT_TRUE(test::happens([&] {
    if (sent < bytes.size()) socket.sendSome(&bytes[sent++], 1);  // every few ms
    return events.count("silent") == 1;
  })) << events.text();
  EXPECT_LT(sent, bytes.size());
}

}  // namespace
}  // namespace hybrid_slam::live
