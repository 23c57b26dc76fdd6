#include "slam/grid/CowPtr.h"

#include <gtest/gtest.h>

#include <memory>
#include <thread>
#include <vector>

namespace hybrid_slam {
namespace {

TEST(CowPtr, IsEmptyUntilItIsWritten) {
  CowPtr<int> p;
  EXPECT_FALSE(p);
  EXPECT_EQ(p.get(), nullptr);
  EXPECT_EQ(p.write(), 0);
  EXPECT_TRUE(p);
}

TEST(CowPtr, CopiesShareUntilOneWrites) {
  CowPtr<int> a(5), b = a;
  EXPECT_TRUE(a.sharesWith(b));
  b.write() = 6;
  EXPECT_FALSE(a.sharesWith(b));
  EXPECT_EQ(*a, 5);
  EXPECT_EQ(*b, 6);
}

TEST(CowPtr, AnUnsharedValueIsWrittenInPlace) {
  CowPtr<int> a(5);
  const int* before = a.get();
  { const auto passing = std::make_unique<CowPtr<int>>(a); }
  a.write() = 6;
  EXPECT_EQ(a.get(), before);
}

/// A value that counts its copies.
struct Counted {
  int* copies;
  explicit Counted(int* count) : copies(count) {}
  Counted() : copies(nullptr) {}
  Counted(const Counted& other) : copies(other.copies) { ++*copies; }
};

TEST(CowPtr, OnlyASharedValueIsCopiedAndOnlyOnce) {
  int copies = 0;
  CowPtr<Counted> a{Counted(&copies)};
  const int made = copies;  // by moving the first value in
  CowPtr<Counted> b = a, c = b;
  EXPECT_EQ(copies, made);
  b.write(), b.write();
  EXPECT_EQ(copies, made + 1);
  a.write();
  c.write();  // the last owner
  EXPECT_EQ(copies, made + 2);
}

TEST(CowPtr, ThreadsWriteCopiesOfOneValue) {
  for (int round = 0; round < 200; ++round) {
    std::vector<CowPtr<std::vector<int>>> copies(4, CowPtr<std::vector<int>>(std::vector<int>(100, round)));
    std::vector<std::thread> threads;
    for (size_t i = 0; i < copies.size(); ++i)
      threads.emplace_back([&, i] {
        for (int& v : copies[i].write()) v += static_cast<int>(i);
      });
    for (auto& thread : threads) thread.join();
    for (size_t i = 0; i < copies.size(); ++i)
      ASSERT_EQ(*copies[i], std::vector<int>(100, round + static_cast<int>(i)));
  }
}

}  // namespace
}  // namespace hybrid_slam
