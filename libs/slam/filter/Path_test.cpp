#include "slam/filter/Path.h"

#include <gtest/gtest.h>

#include "base/RandomStream.h"

namespace hybrid_slam {
namespace {

using mrpt::math::TPose2D;

TPose2D pose(size_t i) { return {static_cast<double>(i), 0, 0}; }

TEST(Path, AnEmptyPathIsAtTheOrigin) {
  const Path path;
  EXPECT_TRUE(path.empty());
  EXPECT_EQ(path.size(), 0u);
  EXPECT_EQ(path.back(), TPose2D());
  EXPECT_TRUE(path.poses().empty());
}

TEST(Path, ListsItsPosesOldestFirst) {
  Path path;
  for (size_t i = 0; i < 5; ++i) path.push(pose(i));
  EXPECT_EQ(path.size(), 5u);
  EXPECT_EQ(path.back(), pose(4));
  EXPECT_EQ(path.poses(), (std::vector<TPose2D>{pose(0), pose(1), pose(2), pose(3), pose(4)}));
  EXPECT_EQ(path.newest(2), (std::vector<TPose2D>{pose(3), pose(4)}));
  EXPECT_EQ(path.newest(9), path.poses());
}

TEST(Path, TheLastMotionIsInTheFrameOfThePreviousPose) {
  Path path;
  EXPECT_EQ(path.lastMotion(), TPose2D());
  path.push({1, 2, M_PI / 2});
  EXPECT_EQ(path.lastMotion(), TPose2D());
  path.push({1, 5, M_PI});
  EXPECT_NEAR(path.lastMotion().x, 3, 1e-12);
  EXPECT_NEAR(path.lastMotion().y, 0, 1e-12);
  EXPECT_NEAR(path.lastMotion().phi, M_PI / 2, 1e-12);
}

TEST(Path, CopiesShareUntilOneGrows) {
  Path first;
  first.push(pose(0));
  Path second = first;
  EXPECT_TRUE(first.sharesWith(second));
  second.push(pose(1));
  EXPECT_FALSE(first.sharesWith(second));
  first.push(pose(1));  // the same pose, but reached by another particle
  EXPECT_FALSE(first.sharesWith(second));
  EXPECT_EQ(first.poses(), second.poses());
}

/// Compares random ancestries with plain lists.
TEST(Path, RandomCopiesAgreeWithLists) {
  RandomStream random(1, 0, 0);
  std::vector<Path> paths(10);
  std::vector<std::vector<TPose2D>> lists(10);
  for (size_t step = 0; step < 5000; ++step) {
    const size_t i = random.bits() % 10, j = random.bits() % 10;
    if (random.uniform() < 0.2) {
      paths[i] = paths[j];
      lists[i] = lists[j];
    } else {
      paths[i].push(pose(step));
      lists[i].push_back(pose(step));
    }
  }
  for (size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(paths[i].poses(), lists[i]);
    EXPECT_EQ(paths[i].size(), lists[i].size());
  }
}

TEST(Path, AMillionPosesAreFreedWithoutDeepRecursion) {
  Path path;
  for (size_t i = 0; i < 1000000; ++i) path.push(pose(i));
  EXPECT_EQ(path.size(), 1000000u);
  path = Path();
  EXPECT_TRUE(path.empty());
}

TEST(Path, ABranchKeepsItsPartOfALongPath) {
  Path path, branch;
  for (size_t i = 0; i < 1000000; ++i) {
    path.push(pose(i));
    if (i == 600000) branch = path;
  }
  path = Path();
  const auto poses = branch.poses();
  ASSERT_EQ(poses.size(), 600001u);
  EXPECT_EQ(poses.front(), pose(0));
  EXPECT_EQ(poses.back(), pose(600000));
}

}  // namespace
}  // namespace hybrid_slam
