#include "base/Errors.h"

#include <gtest/gtest.h>
#include <mrpt/core/exceptions.h>

#include <new>
#include <stdexcept>

namespace hybrid_slam {
namespace {

TEST(MessageOf, LackingMemoryHasOneName) {
  const std::runtime_error mrpts("dereferencing nullptr poly_ptr"), another("out of range"),
      opencvs(
          "OpenCV(4.6.0) ./modules/core/src/alloc.cpp:73: error: (-4:Insufficient memory) Failed to allocate "
          "12004848 bytes in function 'OutOfMemoryError'");
  EXPECT_EQ(messageOf(std::bad_alloc()), "out of memory");
  EXPECT_EQ(messageOf(mrpts), "out of memory");
  EXPECT_TRUE(isOutOfMemory(std::bad_alloc()));
  EXPECT_TRUE(isOutOfMemory(mrpts));
  EXPECT_TRUE(isOutOfMemory(opencvs));
  EXPECT_FALSE(isOutOfMemory(another));
}

TEST(MessageOf, TheMessageOfAnMrptException) {
  try {
    THROW_EXCEPTION("Value `x`\nnot found\n");
  } catch (const std::exception& e) {
    EXPECT_EQ(messageOf(e), "Value `x` not found");
  }
}

TEST(MessageOf, AQuotedExceptionIsWithoutItsCallStack) {
  try {
    try {
      THROW_EXCEPTION("inner\nmessage");
    } catch (const std::exception& e) {
      THROW_EXCEPTION_FMT("outer: %s after it", e.what());
    }
  } catch (const std::exception& e) {
    EXPECT_EQ(messageOf(e), "outer: inner message  after it");
    EXPECT_EQ(messageOf(std::runtime_error(e.what())), "outer: inner message  after it");
  }
}

TEST(InputError, AZeroByteDoesNotEndTheMessage) {
  EXPECT_STREQ(InputError("no such file", std::string("a\0b\0", 4), "expected one").what(),
               "no such file: a\\x00b\\x00; expected one");
}

TEST(MessageOf, OtherMessagesAreUnchanged) {
  EXPECT_EQ(messageOf(std::runtime_error("one\ntwo\n")), "one two");
}

}  // namespace
}  // namespace hybrid_slam
