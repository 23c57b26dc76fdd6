#include "io/ErrorText.h"

#include <gtest/gtest.h>
#include <mrpt/core/exceptions.h>

#include <stdexcept>

namespace hybrid_slam {
namespace {

TEST(ErrorText, TheMessageOfAnMrptException) {
  try {
    THROW_EXCEPTION("Value `x`\nnot found\n");
  } catch (const std::exception& e) {
    EXPECT_EQ(oneLine(e), "Value `x` not found");
  }
}

TEST(ErrorText, OthersAsTheyAre) {
  EXPECT_EQ(oneLine(std::runtime_error("one\ntwo\n")), "one two");
  EXPECT_EQ(oneLine(std::bad_alloc()), "std::bad_alloc");
}

}  // namespace
}  // namespace hybrid_slam
