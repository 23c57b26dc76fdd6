#include "live/ColaTelegram.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hybrid_slam::live::cola {
namespace {

using testing::ElementsAre;

/// A scan of an LMS-100 with three beams from -45 deg by 0.5 deg, in SICK's layout. Replaces part of it.
std::string scanTelegram(const std::string& part = "", const std::string& by = "") {
  std::string text =
      "sSN LMDscandata 1 1 89A27F 0 0 343 347 27477BA9 2747813B 0 0 7 0 0 1388 168 0 1 DIST1 3F800000 "
      "00000000 FFF92230 1388 3 3E8 0 4E20 0 0 0 0 0 0";
  if (!part.empty()) text.replace(text.find(part), part.size(), by);
  return text;
}

TEST(ColaTelegram, AScan) {
  const auto scan = decodeScan(scanTelegram());
  ASSERT_TRUE(scan);
  EXPECT_NEAR(scan->first, -M_PI / 4, 1e-9);
  EXPECT_NEAR(scan->step, M_PI / 360, 1e-9);
  EXPECT_THAT(scan->ranges, ElementsAre(1.F, 0.F, 20.F));
  EXPECT_TRUE(decodeScan(scanTelegram("sSN", "sRA")));
}

TEST(ColaTelegram, ScaleOffsetEncodersAndSignedNumbers) {
  EXPECT_THAT(decodeScan(scanTelegram("3F800000", "40000000"))->ranges, ElementsAre(2.F, 0.F, 40.F));
  EXPECT_THAT(decodeScan(scanTelegram("00000000 FFF", "42C80000 FFF"))->ranges,
              ElementsAre(testing::FloatEq(1.1F), 0.F, testing::FloatEq(20.1F)))
      << "100 mm; no return stays none";
  EXPECT_TRUE(decodeScan(scanTelegram("168 0 1", "168 1 7 9 1"))) << "with an encoder";
  const auto scan = decodeScan(scanTelegram("FFF92230 1388 3", "-450000 +5000 +3"));
  ASSERT_TRUE(scan);
  EXPECT_NEAR(scan->first, -M_PI / 4, 1e-9);
  EXPECT_NEAR(scan->step, M_PI / 360, 1e-9);
}

TEST(ColaTelegram, AnythingElseIsNoScan) {
  for (const std::string& other : {std::string(), std::string("sAN LMCstartmeas 0"), std::string("sSN"),
                                   std::string("sSN LMDscandata "), std::string(100, ' ')})
    EXPECT_FALSE(decodeScan(other)) << other;
  const std::string whole = scanTelegram();
  const size_t end = whole.find(" 4E20");  // the last distance
  for (size_t length = 0; length <= end; ++length)
    EXPECT_FALSE(decodeScan(whole.substr(0, length))) << length;
  const std::pair<const char*, const char*> changes[] = {{"DIST1", "RSSI1"},
                                                         {"3F800000", "7FC00000"},
                                                         {"3F800000", "BF800000"},
                                                         {"3F800000", "0"},
                                                         {"00000000", "7F800000"},
                                                         {"1388 3 ", "0 3 "},
                                                         {"1388 3 ", "1388 1 "},
                                                         {"1388 3 ", "1388 7D1 "},
                                                         {"1388 3 ", "1388 FFFFFFFF "},
                                                         {"1388 3 ", "AAAAA 7 "},
                                                         {"FFF92230", "7FFFFFFF"},
                                                         {"168 0 1", "168 FFFFFFFF 1"},
                                                         {"168 0 1", "168 0 0"},
                                                         {"168 0 1", "168 0 9"},
                                                         {"3E8", "3E8F0"},
                                                         {"3E8", "3G8"},
                                                         {"3E8", "-1"},
                                                         {"3E8", "+-1"},
                                                         {"3E8", "3E8F0000000000"}};
  for (const auto& [part, by] : changes)
    EXPECT_FALSE(decodeScan(scanTelegram(part, by))) << part << " -> " << by;
}

TEST(ColaTelegram, AStreamIsSplitWhereverItIsCut) {
  const std::string stream = "noise" + encode("one") + "\x03" + encode("") + "\x02half" + encode("two") +
                             "\n" + encode(scanTelegram());
  for (size_t cut = 0; cut <= stream.size(); ++cut) {
    Decoder decoder;
    std::vector<std::string> telegrams;
    for (const std::string& part : {stream.substr(0, cut), stream.substr(cut)}) {
      decoder.feed(part);
      while (const auto telegram = decoder.next()) telegrams.push_back(*telegram);
    }
    EXPECT_THAT(telegrams, ElementsAre("one", "two", scanTelegram())) << cut;
  }
}

TEST(ColaTelegram, NoiseWithoutEndIsForgotten) {
  std::mt19937 random(1);
  Decoder decoder;
  for (int i = 0; i < 1000; ++i) {
    std::string noise(1000, ' ');
    for (char& c : noise) c = static_cast<char>('\x04' + random() % 200);
    decoder.feed(noise);
    EXPECT_FALSE(decoder.next());
  }
  decoder.feed(encode("one"));
  EXPECT_EQ(decoder.next(), "one");
}

}  // namespace
}  // namespace hybrid_slam::live::cola
