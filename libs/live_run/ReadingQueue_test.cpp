#include "live_run/ReadingQueue.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

namespace hybrid_slam::live {
namespace {

using mrpt::math::TPose2D;

readings::Reading reading(double time, const TPose2D& motion = {1, 0, 0}) { return {{}, time, motion}; }

TEST(ReadingQueue, KeepsUpToItsLimitInOrder) {
  ReadingQueue queue(3);
  for (int i = 0; i < 3; ++i) queue.push(reading(i), {});
  queue.close();
  for (int i = 0; i < 3; ++i) {
    const auto next = queue.pop();
    ASSERT_TRUE(next);
    EXPECT_EQ(next->reading.timestamp, i);
    EXPECT_EQ(next->skipped, 0u);
    EXPECT_EQ(next->reading.motion, TPose2D(1, 0, 0));
  }
  EXPECT_FALSE(queue.pop());
}

TEST(ReadingQueue, BeyondTheLimitTheNewestCarriesTheMotionOfAll) {
  ReadingQueue queue(3);
  for (int i = 0; i < 4; ++i) queue.push(reading(i, {1, 0, M_PI / 2}), {});
  queue.push(reading(4), {});
  queue.close();
  const auto newest = queue.pop();
  ASSERT_TRUE(newest);
  EXPECT_EQ(newest->reading.timestamp, 3);
  EXPECT_EQ(newest->skipped, 3u);
  EXPECT_NEAR(newest->reading.motion.x, 0, 1e-12) << "once round a square";
  EXPECT_NEAR(newest->reading.motion.y, 0, 1e-12);
  const auto after = queue.pop();
  EXPECT_EQ(after->reading.timestamp, 4);
  EXPECT_EQ(after->skipped, 0u);
  EXPECT_FALSE(queue.pop());
}

TEST(ReadingQueue, AfterTheDeadlineTheNewestCarriesTheMotionOfAll) {
  ReadingQueue queue(10);
  for (int i = 0; i < 5; ++i) queue.push(reading(i), {});
  EXPECT_EQ(queue.pop()->reading.timestamp, 0);
  queue.close(ReadingQueue::Clock::now());
  const auto newest = queue.pop();
  ASSERT_TRUE(newest);
  EXPECT_EQ(newest->reading.timestamp, 4);
  EXPECT_EQ(newest->skipped, 3u);
  EXPECT_EQ(newest->reading.motion, TPose2D(4, 0, 0));
  EXPECT_FALSE(queue.pop());
}

TEST(ReadingQueue, EveryReadingIsTakenOrSkipped) {
  ReadingQueue queue(2);
  constexpr int kCount = 20000;
  size_t taken = 0, skipped = 0;
  double way = 0;
  std::thread filter([&] {
    while (const auto next = queue.pop()) ++taken, skipped += next->skipped, way += next->reading.motion.x;
  });
  for (int i = 0; i < kCount; ++i) queue.push(reading(i), {});
  queue.close();
  filter.join();
  EXPECT_EQ(taken + skipped, static_cast<size_t>(kCount));
  EXPECT_EQ(way, kCount);
}

}  // namespace
}  // namespace hybrid_slam::live
