#include "base/Errors.h"

#include <gtest/gtest.h>
#include <mrpt/core/exceptions.h>

#include <stdexcept>

namespace hybrid_slam {
namespace {

TEST(MessageOf, TheMessageOfAnMrptException) {
  try {
    THROW_EXCEPTION("Value `x`\nnot found\n");
  } catch (const std::exception& e) {
    EXPECT_EQ(messageOf(e), "Value `x` not found");
  }
}

TEST(MessageOf, OtherMessagesAreUnchanged) {
  EXPECT_EQ(messageOf(std::runtime_error("one\ntwo\n")), "one two");
  EXPECT_EQ(messageOf(std::bad_alloc()), "std::bad_alloc");
}

}  // namespace
}  // namespace hybrid_slam
