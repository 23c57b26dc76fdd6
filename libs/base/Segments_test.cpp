#include "base/Segments.h"

#include <gtest/gtest.h>

namespace hybrid_slam {
namespace {

using mrpt::math::TPoint2D;

void expectNearest(const TPoint2D& p, const TPoint2D& a, const TPoint2D& b, const TPoint2D& expected) {
  EXPECT_NEAR((nearestOnSegment(p, a, b) - expected).norm(), 0, 1e-12) << p.asString();
}

TEST(Segments, TheNearestPointIsAFootOrAnEnd) {
  const TPoint2D a(1, 1), b(4, 5);  // 5 m
  expectNearest({2.2 - 4, 2.6 + 3}, a, b, {2.2, 2.6});
  expectNearest({-2, -3}, a, b, a);
  expectNearest({1 + 4, 1 - 3}, a, b, a);
  expectNearest({7, 9}, a, b, b);
}

TEST(Segments, OneWithoutLengthIsItsPoint) { expectNearest({3, 4}, {1, 1}, {1, 1}, {1, 1}); }

}  // namespace
}  // namespace hybrid_slam
