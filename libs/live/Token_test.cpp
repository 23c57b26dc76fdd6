#include "live/Token.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/Errors.h"
#include "files/TemporaryFolder.h"
#include "testing/ListeningClient.h"

namespace hybrid_slam::live {
namespace {

using test::cycle;
using test::kThisMachine;
using test::limits;
using test::Listener;

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

TEST(Connection, OnlyClientsWithTheTokenGetData) {
  const std::string token = "0123456789abcdef";
  test::Events events;
  ObservationServer server(kThisMachine, 0, {20, 10, 30, token}, events.log());
  TcpSocket silent = TcpSocket::connectTo(kThisMachine, server.port(), 10);
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

}  // namespace
}  // namespace hybrid_slam::live
