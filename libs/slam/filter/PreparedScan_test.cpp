#include "slam/filter/PreparedScan.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "testing/RoomLog.h"

namespace hybrid_slam {
namespace {

/// Ranges with many beams close together, and with bends at which lines split beam by beam.
double hostileRange(int shape, size_t i) {
  switch (shape) {
    case 0:
      return 1e-3;
    case 1:
      return 1 + 1e-6 * static_cast<double>(i);
    case 2:
      return i % 2 == 0 ? 1 : 1.1;
    default:
      return 0.5 + 1e-12 * static_cast<double>(i) * static_cast<double>(i);
  }
}

/// If the time grew with the square of the number of beams, the test would exceed its time limit in CMake.
TEST(ScanPreparation, AMillionBeamsOfAnyShape) {
  const auto scan = test::scan(1, {}, 1000000);
  for (const LineExtractor* extractor : lineExtractors())
    for (int shape = 0; shape < 4; ++shape) {
      for (size_t i = 0; i < scan->getScanSize(); ++i)
        scan->setScanRange(i, static_cast<float>(hostileRange(shape, i)));
      FilterConfiguration c;
      c.lineExtraction.method = extractor;
      const PreparedScan prepared = ScanPreparation(c)({scan});
      EXPECT_FALSE(prepared.matchedBeams.rays.empty()) << extractor->name << ", shape " << shape;
    }
}

/// The shortest of the beams, m.
double shortest(const ScanBeams& beams) {
  double least = 100;
  for (const ScanBeams::Ray& ray : beams.rays) least = std::min(least, ray.range);
  return least;
}

TEST(ScanPreparation, PeopleAreNeitherMatchedNorWeighed) {
  const FilterConfiguration c;
  const ScanPreparation prepare(c);
  const auto seen = test::scan(1);
  const PreparedScan empty = prepare({seen});
  OccupancyGrid map;
  for (int i = 0; i < 20; ++i) map.insert(empty.beams, {}, c.grid);
  const PreparedScan same = prepare.withoutMovedThings(empty, {}, map);
  EXPECT_EQ(same.matchedBeams.rays.size(), empty.matchedBeams.rays.size());
  EXPECT_EQ(shortest(same.matchedBeams), shortest(empty.matchedBeams));

  for (const size_t first : {20, 60, 90, 130})  // people 1.5 m away
    for (size_t i = first; i < first + 12; ++i) seen->setScanRange(i, 1.5F);
  const PreparedScan among = prepare({seen}), still = prepare.withoutMovedThings(among, {}, map);
  EXPECT_LT(shortest(among.matchedBeams), 2);
  EXPECT_LT(shortest(among.weighedBeams), 2);
  EXPECT_GT(shortest(still.matchedBeams), 2.5);
  EXPECT_GT(shortest(still.weighedBeams), 2.5);
  EXPECT_EQ(still.matchedBeams.rays.size(), among.matchedBeams.rays.size()) << "others are taken";
  EXPECT_EQ(still.beams.rays.size(), among.beams.rays.size()) << "the map shows them";
}

}  // namespace
}  // namespace hybrid_slam
