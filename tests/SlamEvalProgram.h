/// @file SlamEvalProgram.h
/// @brief For the tests: runs slam-eval in a temporary folder.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "Shell.h"
#include "files/TemporaryFolder.h"

namespace hybrid_slam {

struct SlamEval : testing::Test {
  files::TemporaryFolder folder;

  void write(const std::string& file, const std::string& text) const { folder.write(file, text); }

  test::Outcome shell(const std::string& command) const { return test::shell(folder, command); }
  test::Outcome run(const std::string& arguments) const {
    return shell("'" SLAM_EVAL_PROGRAM "' " + arguments);
  }
  nlohmann::json figures(const std::string& arguments) const {
    const test::Outcome o = run(arguments);
    EXPECT_EQ(o.status, 0) << o.err;
    EXPECT_THAT(o.err, testing::AnyOf("", testing::StartsWith("slam-eval: warning: ")));
    return o.status == 0 ? nlohmann::json::parse(o.out) : nlohmann::json();
  }
  /// Expects exit code 2, nothing on standard output, and one line on standard error, which it returns.
  std::string errorLine(const std::string& arguments) const {
    const test::Outcome o = run(arguments);
    test::expectInputError(o, "slam-eval", "");
    return o.err.substr(0, o.err.find('\n'));
  }
};

/// A trajectory along x, 1 m in each of its 3 s.
inline const char* const kStraight =
    "0 0 0 0 0 0 0 1\n"
    "1 1 0 0 0 0 0 1\n"
    "2 2 0 0 0 0 0 1\n"
    "3 3 0 0 0 0 0 1\n";

}  // namespace hybrid_slam
