#include "live/ArcosPacket.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "live/SipOdometry.h"

namespace hybrid_slam::live {
namespace {

using arcos::Payload;
using testing::ElementsAre;

std::string bytesOf(const std::vector<int>& values) {
  std::string bytes;
  for (const int value : values) bytes.push_back(static_cast<char>(value));
  return bytes;
}

/// A server information packet as a robot sends it: x = 1000, y = 32760, heading -1024 (a quarter turn to the
/// right), standing still, 12.8 V, no sonars.
const std::string kSip =
    bytesOf({0xFA, 0xFB, 0x18, 0x32, 0xE8, 0x03, 0xF8, 0x7F, 0x00, 0xFC, 0x00, 0x00, 0x00, 0x00,
             0x80, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0xB2, 0x60});

std::vector<Payload> decodedBy(arcos::Decoder& decoder, const std::string& bytes) {
  std::vector<Payload> all;
  decoder.feed(bytes);
  while (const auto payload = decoder.next()) all.push_back(*payload);
  return all;
}

TEST(ArcosPacket, CommandsMatchTheManual) {
  EXPECT_EQ(arcos::encode({arcos::sync0}), bytesOf({0xFA, 0xFB, 3, 0, 0, 0}));
  EXPECT_EQ(arcos::encode({arcos::sync1}), bytesOf({0xFA, 0xFB, 3, 1, 0, 1}));
  EXPECT_EQ(arcos::encode({arcos::sync2}), bytesOf({0xFA, 0xFB, 3, 2, 0, 2}));
  EXPECT_EQ(arcos::encode({arcos::open}), bytesOf({0xFA, 0xFB, 3, 1, 0, 1}));
  // ENABLE 1, which this project never sends: an even number of bytes.
  EXPECT_EQ(arcos::encode({4, 0x3B, 1, 0}), bytesOf({0xFA, 0xFB, 6, 4, 0x3B, 1, 0, 5, 0x3B}));
}

TEST(ArcosPacket, TheChecksumXorsAnOddLastByte) {
  EXPECT_EQ(arcos::checksum({0x12, 0x34, 0x56}), 0x1234 ^ 0x56);
  EXPECT_EQ(arcos::checksum({0xFF, 0xFF, 0x00, 0x02}), 0x0001) << "16 bits";
}

TEST(ArcosPacket, DecodesASip) {
  arcos::Decoder decoder;
  const auto payloads = decodedBy(decoder, kSip);
  ASSERT_EQ(payloads.size(), 1u);
  const auto sip = arcos::decodeSip(payloads[0]);
  ASSERT_TRUE(sip);
  EXPECT_EQ(sip->x, 1000);
  EXPECT_EQ(sip->y, 32760);
  EXPECT_EQ(sip->heading, -1024);
  EXPECT_FALSE(sip->isMoving);
}

TEST(ArcosPacket, TheHighestBitOfACounterIsIgnored) {
  EXPECT_EQ(arcos::decodeSip({0x33, 0x01, 0x80, 0, 0, 0, 0})->x, 1);
  EXPECT_TRUE(arcos::decodeSip({0x33, 0, 0, 0, 0, 0, 0})->isMoving);
}

TEST(ArcosPacket, OtherPacketsAreNotSips) {
  EXPECT_FALSE(arcos::decodeSip({0xB0, 0, 0, 0, 0, 0, 0})) << "I/O";
  EXPECT_FALSE(arcos::decodeSip({0x32, 0, 0, 0, 0, 0})) << "too short";
  EXPECT_FALSE(arcos::decodeSip({}));
}

TEST(ArcosPacket, ArrivesByteByByte) {
  arcos::Decoder decoder;
  size_t packets = 0;
  for (const char byte : kSip + kSip) packets += decodedBy(decoder, std::string(1, byte)).size();
  EXPECT_EQ(packets, 2u);
  EXPECT_EQ(decoder.damaged(), 0u);
}

TEST(ArcosPacket, FindsThePacketsInNoise) {
  for (const std::string& noise :
       {std::string("noise"), bytesOf({0xFA}), bytesOf({0xFA, 0xFA, 0xFB}), bytesOf({0xFA, 0xFB, 0xFF}),
        bytesOf({0xFA, 0xFB, 0, 0xFA, 0xFB, 2}), kSip.substr(0, 9), std::string(1000, '\0')}) {
    arcos::Decoder decoder;
    // A false packet header may claim bytes of the next packets, which must still be found.
    const auto payloads = decodedBy(decoder, noise + kSip + noise + kSip + kSip + std::string(300, 'x'));
    EXPECT_EQ(payloads.size(), 3u) << testing::PrintToString(noise);
  }
}

TEST(ArcosPacket, EveryChangedBitIsDetected) {
  for (size_t i = 0; i < kSip.size(); ++i)
    for (int bit = 0; bit < 8; ++bit) {
      std::string wrong = kSip;
      wrong[i] = static_cast<char>(wrong[i] ^ (1 << bit));
      arcos::Decoder decoder;
      EXPECT_TRUE(decodedBy(decoder, wrong + std::string(300, 'x')).empty())
          << "byte " << i << ", bit " << bit;
      if (i >= 2) {
        EXPECT_GE(decoder.damaged(), 1u) << "byte " << i << ", bit " << bit;
      }
    }
}

TEST(ArcosPacket, MemoryDoesNotGrowWithNoise) {
  arcos::Decoder decoder;
  for (int i = 0; i < 1000; ++i) decodedBy(decoder, std::string(1000, '\xFA'));
  EXPECT_EQ(decodedBy(decoder, kSip).size(), 1u);
}

arcos::Sip sip(int x, int y, int heading = 0) {
  return {static_cast<uint16_t>(x & 0x7fff), static_cast<uint16_t>(y & 0x7fff), static_cast<int16_t>(heading),
          true};
}

TEST(SipOdometry, ContinuesAcrossTheWrapAround) {
  SipOdometry odometry(0.001);
  odometry(sip(32700, 100));
  auto pose = odometry(sip(32767, 0));
  EXPECT_NEAR(pose.x, 0.067, 1e-12);
  EXPECT_NEAR(pose.y, -0.1, 1e-12);
  pose = odometry(sip(32868, -200));  // after the counters wrapped around
  EXPECT_NEAR(pose.x, 0.168, 1e-12);
  EXPECT_NEAR(pose.y, -0.3, 1e-12);
  for (int i = 1; i <= 1000; ++i) pose = odometry(sip(32868 - 100 * i, -200 + 100 * i));
  EXPECT_NEAR(pose.x, 0.168 - 100, 1e-9) << "three times round";
  EXPECT_NEAR(pose.y, -0.3 + 100, 1e-9);
}

TEST(SipOdometry, StartsAtZeroAndUsesTheUnitsOfItsRobot) {
  SipOdometry odometry(0.000485);
  EXPECT_EQ(odometry(sip(5000, 6000)).x, 0);
  EXPECT_NEAR(odometry(sip(6000, 6000)).x, 0.485, 1e-12);
}

TEST(SipOdometry, HeadingHas4096UnitsPerTurn) {
  SipOdometry odometry(0.001);
  EXPECT_NEAR(odometry(sip(0, 0, 1024)).phi, M_PI / 2, 1e-12);
  EXPECT_NEAR(odometry(sip(0, 0, -1024)).phi, -M_PI / 2, 1e-12);
  EXPECT_NEAR(odometry(sip(0, 0, 3072)).phi, -M_PI / 2, 1e-12);
  EXPECT_NEAR(odometry(sip(0, 0, 4096 + 1024)).phi, M_PI / 2, 1e-12);
}

}  // namespace
}  // namespace hybrid_slam::live
