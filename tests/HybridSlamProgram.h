/// @file HybridSlamProgram.h
/// @brief For the tests: runs hybrid-slam and checks exit code, messages and files.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "ResultFiles.h"
#include "Shell.h"
#include "testing/TestLogs.h"

namespace hybrid_slam {

inline const std::string kErrorLine = test::errorLineOf("hybrid-slam");

class HybridSlam : public test::ProgramTest {
 protected:
  HybridSlam() : ProgramTest(HYBRID_SLAM) {}
  /// Replays a log with the test's INI file into `output`, in place of earlier results.
  int replay(const std::string& log, const std::string& options = "", const std::string& before = "") {
    return run("'" + ini + "' '" + log + "' --overwrite -o '" + output + "' " + options, before);
  }
  int replay(const test::Log& log, const std::string& options = "") {
    return replay(test::writeGzipped(folder.path("log.rawlog"), log), options);
  }
  std::string result(const std::string& name) const { return test::contentOf(output + "/" + name); }
  std::vector<std::string> results() const { return test::namesIn(output); }
  /// Expects exit code 2, one error line and no file.
  void expectError(int exitCode, const std::string& text) {
    test::expectInputError({exitCode, out, err}, "hybrid-slam", text);
    EXPECT_THAT(results(), testing::IsEmpty());
  }
  /// Expects exit code 0, all results, and nothing on standard error but `warning`.
  void expectDone(int exitCode, const std::string& warning = "") {
    EXPECT_EQ(exitCode, 0) << err;
    std::vector<std::string> expected = test::kResults;
    const std::string metrics = result("metrics.json");
    const auto isMethod = [&](const std::string& name) {
      return metrics.find("\"method\": \"" + name + "\"") != std::string::npos;
    };
    if (isMethod("ortho") || isMethod("stock"))
      expected.erase(std::find(expected.begin(), expected.end(), "session.hslam"));
    if (isMethod("general") || isMethod("stock"))
      expected.erase(std::remove_if(expected.begin(), expected.end(),
                                    [](const std::string& name) { return name.rfind("plan.", 0) == 0; }),
                     expected.end());
    EXPECT_THAT(results(), testing::UnorderedElementsAreArray(expected));
    err = test::withoutProgress(err);
    if (warning.empty())
      EXPECT_THAT(err, testing::IsEmpty());
    else
      EXPECT_THAT(err, testing::AllOf(testing::MatchesRegex("hybrid-slam: warning: [^\n]*: [^\n]*; [^\n]*\n"),
                                      testing::HasSubstr(warning)));
  }

  std::string ini = folder.write(
      "run.ini",
      "[run]\nmethod = hybrid\n[particle_filter]\nparticles = 5\nproposal = standard\nupdate_distance "
      "= 0.2\n[grid]\nresolution = 0.1\n");
  std::string output = folder.path("out");
};

}  // namespace hybrid_slam
