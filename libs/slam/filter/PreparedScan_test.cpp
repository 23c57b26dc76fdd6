#include "slam/filter/PreparedScan.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace hybrid_slam
