#include "live/ObservationWire.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include "files/TemporaryFolder.h"
#include "testing/ErrorOf.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::live {
namespace {

using testing::HasSubstr;

mrpt::obs::CSensoryFrame cycle() {
  mrpt::obs::CSensoryFrame frame;
  frame.insert(test::odometry(10, {1, 2, 0.5}));
  frame.insert(test::scan(10.1, {0.5, 0.25, 0}));
  return frame;
}

Message message(MessageKind kind = MessageKind::cycle) {
  return {kind, 0x0123456789abcdef, 42, kind == MessageKind::cycle ? serialise(cycle()) : ""};
}

/// The decoder's answer to bytes: "" (incomplete), "message", or the error.
std::string answerTo(const std::string& bytes) {
  MessageDecoder decoder;
  decoder.feed(bytes);
  try {
    return decoder.next() ? "message" : "";
  } catch (const WireError& e) {
    return e.what();
  }
}

std::string errorOf(const std::string& payload) {
  return test::errorOf<WireError>([&] { deserialise(payload); });
}

TEST(ObservationWire, TheHeaderIsAsDocumented) {
  const std::string bytes = encode({MessageKind::heartbeat, 0x0807060504030201, 0x0f0e, {}});
  const std::string expected("HSO1\x02\0\0\0\x01\x02\x03\x04\x05\x06\x07\x08\x0e\x0f\0\0\0\0\0\0\0\0\0\0",
                             28);
  EXPECT_EQ(bytes.substr(0, 28), expected);
  const auto crc = ::crc32(0, reinterpret_cast<const Bytef*>(bytes.data()) + 4, 24);
  EXPECT_EQ(static_cast<unsigned char>(bytes[28]), crc & 0xff);
  EXPECT_EQ(static_cast<unsigned char>(bytes[31]), crc >> 24);
  EXPECT_EQ(bytes.size(), 32u);
}

TEST(ObservationWire, ObservationsRoundTripBitForBit) {
  const auto back = deserialise(serialise(cycle()));
  ASSERT_EQ(back->size(), 2u);
  EXPECT_EQ(serialise(*back), serialise(cycle()));
  const auto scan = back->getObservationByClass<mrpt::obs::CObservation2DRangeScan>();
  const auto original = test::scan(10.1, {0.5, 0.25, 0});
  ASSERT_EQ(scan->getScanSize(), original->getScanSize());
  for (size_t i = 0; i < scan->getScanSize(); ++i)
    EXPECT_EQ(scan->getScanRange(i), original->getScanRange(i));
  EXPECT_EQ(scan->timestamp, original->timestamp);
}

TEST(ObservationWire, MessagesMayArriveByteByByteOrTogether) {
  const std::string bytes = encode(message()) + encode(message(MessageKind::heartbeat)) + encode(message());
  MessageDecoder decoder;
  std::vector<Message> messages;
  for (const char byte : bytes) {
    decoder.feed(std::string(1, byte));
    while (const auto next = decoder.next()) messages.push_back(*next);
  }
  MessageDecoder another;
  another.feed(bytes);
  for (const Message& expected : messages) {
    const auto next = another.next();
    ASSERT_TRUE(next);
    EXPECT_EQ(next->payload, expected.payload);
  }
  EXPECT_FALSE(another.next());
  ASSERT_EQ(messages.size(), 3u);
  EXPECT_EQ(messages[0].session, 0x0123456789abcdefu);
  EXPECT_EQ(messages[0].number, 42u);
  EXPECT_EQ(messages[0].payload, message().payload);
  EXPECT_EQ(messages[1].kind, MessageKind::heartbeat);
}

TEST(ObservationWire, EveryChangedBitIsDetected) {
  const std::string bytes = encode(message());
  for (size_t i = 0; i < bytes.size(); i += i < 40 ? 1 : 97)
    for (int bit = 0; bit < 8; ++bit) {
      std::string wrong = bytes;
      wrong[i] = static_cast<char>(wrong[i] ^ (1 << bit));
      EXPECT_NE(answerTo(wrong), "message") << "byte " << i << ", bit " << bit;
    }
}

TEST(ObservationWire, GarbageIsDetectedImmediately) {
  EXPECT_THAT(answerTo("G"), HasSubstr("not a message"));
  EXPECT_THAT(answerTo("HSO2"), HasSubstr("not a message"));
  EXPECT_EQ(answerTo("HSO"), "");
  std::string bytes = encode(message());
  bytes[4] = 9;
  EXPECT_THAT(answerTo(bytes), HasSubstr("unknown kind 9"));
}

TEST(ObservationWire, ALengthOfFourGigabytesIsAnError) {
  std::string header = encode(message()).substr(0, 32);
  for (size_t i = 24; i < 28; ++i) header[i] = '\xff';
  EXPECT_EQ(answerTo(header), "a message of 4294967295 bytes");
}

TEST(ObservationWire, AWrongChecksum) {
  std::string bytes = encode(message());
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  EXPECT_THAT(answerTo(bytes), HasSubstr("wrong checksum"));
}

TEST(ObservationWire, OnlyOneCompleteFrameIsAccepted) {
  const std::string payload = serialise(cycle());
  EXPECT_EQ(errorOf(payload), "no error");
  EXPECT_THAT(errorOf(payload + "x"), HasSubstr("bytes after"));
  EXPECT_THAT(errorOf(payload.substr(0, payload.size() / 2)), HasSubstr("unreadable object"));
  EXPECT_THAT(errorOf(""), HasSubstr("unreadable object"));
  EXPECT_THAT(errorOf("\x85hello"), HasSubstr("unreadable object"));

  const files::TemporaryFolder folder;
  const auto bytesOf = [&folder](const mrpt::serialization::CSerializable::Ptr& object) {
    return test::contentOf(test::writePlain(folder.path("object"), {object}));
  };
  EXPECT_EQ(errorOf(bytesOf(mrpt::obs::CSensoryFrame::Create(cycle()))), "no error");
  EXPECT_THAT(errorOf(bytesOf(test::action({1, 0, 0}))),
              HasSubstr("class mrpt::obs::CActionCollection instead of"));
  EXPECT_THAT(errorOf(bytesOf(test::scan(1))),
              HasSubstr("class mrpt::obs::CObservation2DRangeScan instead of"));
}

/// A hostile server sends messages with valid checksums.
TEST(ObservationWire, OnlyObservationsOfListedClassesAndWithTheirBytesAreBuilt) {
  const auto object = [](const std::string& name, char version, const std::string& fields) {
    return static_cast<char>(0x80 | name.size()) + name + version + fields;
  };
  const std::string one("\1\0\0\0", 4), many("\0\0\0\x08", 4);
  EXPECT_THAT(errorOf(object("CSensoryFrame", 2, many + "few")), HasSubstr("more than 64 MiB"));
  EXPECT_THAT(
      errorOf(object("CSensoryFrame", 2, one + object("CObservation3DScene", 0, "scene of any kind"))),
      HasSubstr("class CObservation3DScene instead of"));
  std::string nested(20, ' ');
  for (int i = 0; i < 5000; ++i) nested = object("CSensoryFrame", 2, one) + nested;
  EXPECT_THAT(errorOf(nested), HasSubstr("class CSensoryFrame instead of"));
  EXPECT_THAT(errorOf(object("CSensoryFrame", 2, one + "\x87nullptr\x88\x88      ")),
              HasSubstr("class nullptr"));
}

}  // namespace
}  // namespace hybrid_slam::live
