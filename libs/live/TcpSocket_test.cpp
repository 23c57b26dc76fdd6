#include "live/TcpSocket.h"

#include <arpa/inet.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <atomic>
#include <chrono>
#include <cstring>
#include <fstream>
#include <sstream>
#include <thread>
#include <vector>

#include "base/Clock.h"
#include "base/Errors.h"
#include "live/LiveOptions.h"
#include "live/ObservationClient.h"
#include "live/ObservationServer.h"
#include "testing/TestEvents.h"

namespace {

std::atomic<int> slowLookUps{0}, connects{0};  ///< calls below that have begun

}  // namespace

/// In this program `slow.test` is a name whose server does not answer for 20 s, and `two.test` has the
/// addresses 127.0.0.2 and 127.0.0.1, in this order.
extern "C" int getaddrinfo(const char* host, const char* port, const addrinfo* hints, addrinfo** found) {
  static const auto real = reinterpret_cast<decltype(&getaddrinfo)>(dlsym(RTLD_NEXT, "getaddrinfo"));
  if (std::strcmp(host, "slow.test") == 0) {
    ++slowLookUps;
    std::this_thread::sleep_for(std::chrono::seconds(20));
    return EAI_AGAIN;
  }
  if (std::strcmp(host, "two.test") != 0) return real(host, port, hints, found);
  if (const int error = real("127.0.0.2", port, hints, found)) return error;
  return real("127.0.0.1", port, hints, &(*found)->ai_next);
}

extern "C" int connect(int descriptor, const sockaddr* address, socklen_t size) {
  static const auto real = reinterpret_cast<decltype(&connect)>(dlsym(RTLD_NEXT, "connect"));
  ++connects;
  return real(descriptor, address, size);
}

namespace hybrid_slam::live {
namespace {

using Clock = std::chrono::steady_clock;
using test::Events;

/// Listens with a full backlog, so that connection attempts are not answered.
class FullListener {
 public:
  explicit FullListener(const char* address, uint16_t port = 0) {
    place_.sin_family = AF_INET;
    place_.sin_port = htons(port);
    ::inet_pton(AF_INET, address, &place_.sin_addr);
    sockets_.emplace_back(::socket(AF_INET, SOCK_STREAM, 0));
    socklen_t size = sizeof place_;
    (void)::bind(sockets_[0].descriptor(), reinterpret_cast<sockaddr*>(&place_), size);
    ::listen(sockets_[0].descriptor(), 0);
    ::getsockname(sockets_[0].descriptor(), reinterpret_cast<sockaddr*>(&place_), &size);
    for (int i = 0; i < 4; ++i) {
      sockets_.emplace_back(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0));
      (void)::connect(sockets_.back().descriptor(), reinterpret_cast<sockaddr*>(&place_), size);
    }
  }
  uint16_t port() const { return ntohs(place_.sin_port); }

 private:
  sockaddr_in place_{};
  std::vector<TcpSocket> sockets_;
};

/// Returns the time (s) that a client without a server takes to stop after it has made one of `calls`.
double timeToStop(const std::string& host, uint16_t port, const std::atomic<int>& calls) {
  test::Events events;
  ObservationClient client({host, port, 15}, events.log());
  std::atomic<bool> stop{false};
  const int before = calls;
  std::thread thread([&] { client.run([](const auto&) {}, [&] { return stop.load(); }); });
  EXPECT_TRUE(test::happens([&] { return calls > before; }));
  const auto start = Clock::now();
  stop = true;
  thread.join();
  EXPECT_EQ(client.connections(), 0u);
  return secondsSince(start);
}

// The stop flag is checked every 0.1 s; the bound allows for busy machines.
TEST(TcpSocket, StoppingDoesNotWaitForAnAnswer) {
  const FullListener full("127.0.0.1");
  EXPECT_LT(timeToStop("127.0.0.1", full.port(), connects), 3);
}

TEST(TcpSocket, StoppingDoesNotWaitForALookUp) { EXPECT_LT(timeToStop("slow.test", 4550, slowLookUps), 3); }

TEST(TcpSocket, AnUnansweredConnectionTimesOut) {
  const FullListener full("127.0.0.1");
  EXPECT_THROW(TcpSocket::connectTo("127.0.0.1", full.port(), 0.2), std::runtime_error);
  EXPECT_THROW(TcpSocket::connectTo("slow.test", 4550, 0.2), std::runtime_error);
}

TEST(TcpSocket, EveryAddressOfAHostIsTried) {
  TcpListener second("127.0.0.1", 0);
  EXPECT_TRUE(TcpSocket::connectTo("two.test", second.port(), 10).isOpen()) << "the first is refused";
  const FullListener first("127.0.0.2", second.port());
  EXPECT_TRUE(TcpSocket::connectTo("two.test", second.port(), 1).isOpen()) << "the first does not answer";
}

TEST(TcpSocket, ServesIPv6) {
  std::stringstream addresses;
  addresses << std::ifstream("/proc/net/if_inet6").rdbuf();
  if (addresses.str().find(std::string(31, '0') + "1 ") == std::string::npos)
    GTEST_SKIP() << "this machine has no IPv6";
  test::Events events;
  ObservationServer server("::1", 0, {}, events.log());
  const TcpSocket socket = TcpSocket::connectTo("::1", server.port(), 10);
  ASSERT_TRUE(test::happens([&] { return server.clients() == 1; }));
  EXPECT_EQ(events.count("client [::1]:"), 1u) << events.text();
}

TEST(TcpSocket, ListensAtLocalhost) {
  const TcpListener listener("localhost", 0);
  EXPECT_TRUE(TcpSocket::connectTo("127.0.0.1", listener.port(), 10).isOpen());
  EXPECT_TRUE(TcpSocket::connectTo("localhost", listener.port(), 10).isOpen());
}

TEST(HostAndPort, AnIPv6AddressHasBrackets) {
  const std::pair<std::string, uint16_t> loopback{"::1", 4550};
  EXPECT_EQ(hostAndPort("[::1]:4550", ""), loopback);
  EXPECT_EQ(hostAndPort("robot:4550", "").first, "robot");
  for (const char* wrong : {"::1", "::1:4550", "[::1]", "[]:4550", ":4550", "robot:0", "robot:x"})
    EXPECT_THROW(hostAndPort(wrong, ""), InputError) << wrong;
}

}  // namespace
}  // namespace hybrid_slam::live
