#include "base/Memory.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include <new>

#include "testing/Restricted.h"

namespace hybrid_slam {
namespace {

TEST(ResizeScan, SetsTheNumberOfBeams) {
  mrpt::obs::CObservation2DRangeScan scan;
  for (const size_t beams : {541, 0, 2}) {
    resizeScan(scan, beams);
    EXPECT_EQ(scan.getScanSize(), beams);
  }
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they reserve address space
TEST(ResizeScan, WithoutMemoryTheScanStays) {
  mrpt::obs::CObservation2DRangeScan scan;
  resizeScan(scan, 2);
  EXPECT_TRUE(test::throwsWithoutMemory([&] {
    try {
      resizeScan(scan, 541);
    } catch (const std::bad_alloc&) {
      if (scan.getScanSize() == 2) throw;
    }
  }));
}
#endif

}  // namespace
}  // namespace hybrid_slam
