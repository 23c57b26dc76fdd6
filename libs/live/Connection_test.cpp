/// Server and client over loopback, and faults between them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <mutex>

#include "base/Errors.h"
#include "files/TemporaryFolder.h"
#include "live/ObservationClient.h"
#include "live/ObservationServer.h"
#include "live/Token.h"
#include "testing/TestEvents.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::live {
namespace {

using mrpt::obs::CSensoryFrame;
using test::Events;
using test::happens;

mrpt::obs::CSensoryFrame cycle(double time, double x = 0, size_t beams = 181) {
  CSensoryFrame frame;
  frame.insert(test::odometry(time, {x, 0, 0}));
  frame.insert(test::scan(time, {}, beams));
  return frame;
}

/// A client in a separate thread, with its received cycles.
class Listener {
 public:
  Listener(uint16_t port, test::Events& events, double timeout = 30, const std::string& token = "")
      : client_({"127.0.0.1", port, timeout, token}, events.log()), thread_([this] {
          client_.run([this](const CSensoryFrame::Ptr& frame) { take(*frame); },
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
  const ObservationClient& client() const { return client_; }

 private:
  void take(const CSensoryFrame& frame) {
    const auto odometry = frame.getObservationByClass<mrpt::obs::CObservationOdometry>();
    const std::lock_guard<std::mutex> lock(mutex_);
    odometry_.push_back(odometry->odometry.x());
  }
  std::atomic<bool> stop_{false}, hasReturned_{false};
  mutable std::mutex mutex_;
  std::vector<double> odometry_;
  ObservationClient client_;
  std::thread thread_;
};

const std::string kAnywhere = "127.0.0.1";
ObservationServer::Limits limits(size_t queue = 1000, size_t clients = 250) {
  return {queue, clients, 30, ""};
}

/// Answers each connection with the bytes of the next script, then closes it or falls silent.
class FakeServer {
 public:
  explicit FakeServer(std::vector<std::string> scripts, bool leaves = true)
      : listener_(kAnywhere, 0), thread_([this, scripts = std::move(scripts), leaves] {
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

TEST(Connection, EveryClientGetsEveryCycleUntilTheEnd) {
  test::Events events;
  ObservationServer server(kAnywhere, 0, limits(), events.log());
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
  ObservationServer server(kAnywhere, 0, limits(10000), events.log());
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
  ObservationServer server(kAnywhere, 0, limits(20), events.log());
  TcpSocket lazy = TcpSocket::connectTo(kAnywhere, server.port(), 10);
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

TEST(Connection, AHundredSilentClientsBlockNoOne) {
  test::Events events;
  ObservationServer server(kAnywhere, 0, limits(), events.log());
  std::vector<TcpSocket> silent;
  for (int i = 0; i < 100; ++i) silent.push_back(TcpSocket::connectTo(kAnywhere, server.port(), 30));
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
  ObservationServer server(kAnywhere, 0, limits(10, 2), events.log());
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
  ObservationServer server(kAnywhere, 0, limits(), events.log());
  TcpSocket chatty = TcpSocket::connectTo(kAnywhere, server.port(), 10);
  Listener listener(server.port(), events);
  ASSERT_TRUE(test::happens([&] { return server.clients() == 2; }));
  for (int i = 0; i < 16; ++i) chatty.send(std::string(65536, 'x'), 30);
  server.publish(cycle(1));
  EXPECT_TRUE(test::happens([&] { return listener.count() == 1; }));
}

TEST(Connection, AMissingServerIsRetriedAndReportedOnce) {
  test::Events events;
  uint16_t port = 0;
  {
    TcpListener reserved(kAnywhere, 0);
    port = reserved.port();
  }
  Listener listener(port, events);
  ASSERT_TRUE(test::happens([&] { return listener.client().attempts() > 2; })) << events.text();
  EXPECT_EQ(events.count("refused"), 1u) << events.text();
  ObservationServer server(kAnywhere, port, limits(), events.log());
  ASSERT_TRUE(test::happens([&] { return server.clients() == 1; }));
  server.publish(cycle(1));
  EXPECT_TRUE(test::happens([&] { return listener.count() == 1; }));
}

TEST(Connection, OdometryContinuesAfterAServerRestart) {
  test::Events events;
  auto server = std::make_unique<ObservationServer>(kAnywhere, 0, limits(), events.log());
  const uint16_t port = server->port();
  Listener listener(port, events);
  ASSERT_TRUE(test::happens([&] { return server->clients() == 1; }));
  server->publish(cycle(1, 5));
  server->publish(cycle(2, 6));
  ASSERT_TRUE(test::happens([&] { return listener.count() == 2; }));
  server.reset();
  server = std::make_unique<ObservationServer>(kAnywhere, port, limits(), events.log());
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
  TcpListener listener(kAnywhere, 0);
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

TEST(Connection, AClientThatTakesNothingLeavesItsPlaceToOthers) {
  test::Events events;
  ObservationServer server(kAnywhere, 0, {20, 1, 0.3, ""}, events.log());
  const TcpSocket stuck = TcpSocket::connectTo(kAnywhere, server.port(), 10);
  ASSERT_TRUE(test::happens([&] { return server.clients() == 1; }));
  Listener good(server.port(), events);
  EXPECT_TRUE(test::happens([&] {
    server.publish(cycle(10, 1, 10000));
    return good.count() > 0;
  })) << events.text();
  EXPECT_EQ(events.count("does not read"), 1u) << events.text();
}

TEST(Connection, OnlyClientsWithTheTokenGetData) {
  const std::string token = "0123456789abcdef";
  test::Events events;
  ObservationServer server(kAnywhere, 0, {20, 10, 30, token}, events.log());
  TcpSocket silent = TcpSocket::connectTo(kAnywhere, server.port(), 10);
  Listener good(server.port(), events, 30, token), wrong(server.port(), events, 30, "0123456789abcdeF");
  ASSERT_TRUE(test::happens([&] {
    server.publish(cycle(10));
    return good.count() > 2 && events.count("wrong token") > 0;
  })) << events.text();
  EXPECT_EQ(wrong.count(), 0u);
  EXPECT_EQ(silent.receive(0.1), "");
  EXPECT_EQ(server.clients(), 1u);
}

TEST(Connection, AnotherMachineNeedsAToken) {
  test::Events events;
  for (const char* address : {"0.0.0.0", "::", "192.168.0.7"})
    EXPECT_THROW(ObservationServer(address, 0, limits(), events.log()), InputError) << address;
  const ObservationServer open("0.0.0.0", 0, {20, 10, 30, "0123456789abcdef"}, events.log());
  EXPECT_GT(open.port(), 0);
}

TEST(Token, IsTheFirstLineOfAFile) {
  const files::TemporaryFolder folder;
  const std::string file = folder.path("token");
  const auto read = [&](const std::string& content) {
    std::ofstream(file) << content;
    return readToken(file, "key `token_file`");
  };
  EXPECT_EQ(readToken("", ""), "");
  EXPECT_EQ(read("0123456789abcdef\r\nmore"), "0123456789abcdef");
  EXPECT_EQ(read(std::string(256, 'x')), std::string(256, 'x'));
  EXPECT_THROW(read("short"), InputError);
  EXPECT_THROW(read(std::string(257, 'x')), InputError);
  EXPECT_THROW(readToken(folder.path("missing"), ""), InputError);
  EXPECT_TRUE(isSameToken("abc", "abc"));
  for (const char* other : {"", "ab", "abd", "abcd", "abcabc"})
    EXPECT_FALSE(isSameToken(other, "abc")) << other;
}

TEST(Connection, AnIdleServerSendsHeartbeats) {
  test::Events events;
  ObservationServer server(kAnywhere, 0, limits(), events.log());
  TcpSocket socket = TcpSocket::connectTo(kAnywhere, server.port(), 10);
  MessageDecoder decoder;
  std::optional<Message> message;
  ASSERT_TRUE(test::happens([&] {
    decoder.feed(socket.receive(0.1));
    message = decoder.next();
    return message.has_value();
  }));
  EXPECT_EQ(message->kind, MessageKind::heartbeat);
}

TEST(Connection, AnAddressItCannotListenOnIsAnError) {
  test::Events events;
  ObservationServer server(kAnywhere, 0, limits(), events.log());
  EXPECT_THROW(ObservationServer(kAnywhere, server.port(), limits(), events.log()), InputError);
  EXPECT_THROW(ObservationServer("203.0.113.1", 0, {20, 10, 30, "0123456789abcdef"}, events.log()),
               InputError);
  EXPECT_THROW(ObservationServer("nowhere", 0, limits(), events.log()), InputError);
}

}  // namespace
}  // namespace hybrid_slam::live
