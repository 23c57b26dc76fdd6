/// @file Shell.h
/// @brief For the tests: runs programs from a shell, like users.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <regex>
#include <string>

#include "files/TemporaryFolder.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::test {

struct Outcome {
  int status = -1;  ///< exit code; -1 after a signal
  std::string out, err;
};

/// Runs shell code in a folder.
inline Outcome shell(const files::TemporaryFolder& folder, const std::string& command) {
  const std::string whole = "cd '" + folder.path("") + "' || exit; " + command + " >.out 2>.err";
  const int status = std::system(whole.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, test::contentOf(folder.path(".out")),
          test::contentOf(folder.path(".err"))};
}

/// Runs one program in a temporary folder.
class ProgramTest : public ::testing::Test {
 protected:
  explicit ProgramTest(const std::string& program) : program_(program) {}
  /// Returns the exit code; what the program printed is in `out` and `err`.
  /// @param before  shell code that runs first
  int run(const std::string& arguments, const std::string& before = "") {
    const Outcome outcome = shell(folder, before + "'" + program_ + "' " + arguments);
    out = outcome.out;
    err = outcome.err;
    return outcome.status;
  }

  files::TemporaryFolder folder;
  std::string out, err;

 private:
  std::string program_;
};

/// Standard error after an error, as a regular expression: what, where, what was expected.
inline std::string errorLineOf(const std::string& program) {
  return program + ": error: [^\n]*: [^\n]*; [^\n]*\n";
}

/// Expects exit code 2, nothing on standard output, and one line on standard error. @param part  of that line
inline void expectInputError(const Outcome& outcome, const std::string& program, const std::string& part) {
  EXPECT_EQ(outcome.status, 2) << outcome.err;
  // Standard output may only have settings that were derived from the log before the error.
  EXPECT_EQ(std::regex_replace(outcome.out, std::regex("(laser |[a-z_]+\\.[a-z_]+ = )[^\n]*\n"), ""), "");
  EXPECT_THAT(outcome.err, testing::MatchesRegex(errorLineOf(program)));
  EXPECT_THAT(outcome.err, testing::HasSubstr(part));
}

/// Removes progress lines, which a run of more than ten seconds prints on a busy machine.
inline std::string withoutProgress(const std::string& err) {
  return std::regex_replace(err, std::regex("[0-9]+ of [0-9]+ scans [^\n]*\n"), "");
}

}  // namespace hybrid_slam::test
