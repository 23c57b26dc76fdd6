/// The memory of hybrid-slam, and what is left where it ends.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "ChildProgram.h"
#include "HybridSlamProgram.h"
#include "files/Trajectory.h"

namespace hybrid_slam {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

struct HybridSlamMemory : HybridSlam {
  /// Writes a log of a drive to the north-east; returns its path.
  /// @param step  m in x and in y, between scans @param period  s
  std::string northEast(int scans, double step, double period) const {
    test::Log log;
    for (int i = 0; i < scans; ++i) {
      log.push_back(test::odometry(1000 + period * i, {step * i, step * i, 0}));
      log.push_back(test::scan(1000 + period * i));
    }
    return test::writeGzipped(folder.path("log.rawlog"), log);
  }
};

TEST_F(HybridSlamMemory, WhereTheMapsOfMrptsFilterFillTheMemoryTheResultsEndThere) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers need their address space";
#endif
  const std::string path = northEast(60, 28, 1);
  test::ChildProgram program(folder, "run",
                             {"/bin/sh", "-c",
                              "ulimit -v 1400000; exec '" HYBRID_SLAM "' -q -m stock -n 5 -o '" + output +
                                  "' '" + ini + "' '" + path + "' --set motion_model.turn_var_d=0"});
  EXPECT_EQ(program.wait(), 1);
  EXPECT_THAT(program.err(),
              HasSubstr("run failed: maps of 5 particles too large for MRPT's filter: over 0.7 GB"));
  EXPECT_THAT(program.err(), HasSubstr("results cover the log up to this point"));
  EXPECT_TRUE(fs::exists(output + "/map.png"));
  EXPECT_GT(files::loadTum(output + "/trajectory.tum").size(), 5u);
  EXPECT_EQ(nlohmann::json::parse(result("metrics.json"))["complete"], false);
}

/// A map of 1 km by 1 km, with a limit between what the filter needs and what the largest result needs.
TEST_F(HybridSlamMemory, AResultThatNeedsTooMuchMemoryDoesNotCostTheOthers) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers need their address space";
#endif
  const std::string path = northEast(60, 14, 20);
  size_t incomplete = 0;
  for (const int megabytes : {450, 500, 550, 600, 700, 800}) {
    SCOPED_TRACE(megabytes);
    std::filesystem::remove_all(output);
    test::ChildProgram program(
        folder, "run",
        {"/bin/sh", "-c",
         "ulimit -v " + std::to_string(1024 * megabytes) + "; exec '" HYBRID_SLAM "' -q -n 5 -o '" + output +
             "' '" + ini + "' '" + path + "'"});
    const int status = program.wait();
    if (!fs::exists(output + "/metrics.json")) continue;  // not even the filter had room
    EXPECT_EQ(files::loadTum(output + "/trajectory.tum").size(), 60u);
    const bool isComplete = nlohmann::json::parse(result("metrics.json"))["complete"];
    EXPECT_EQ(isComplete, status == 0);
    incomplete += !isComplete;
    EXPECT_EQ(isComplete, program.err().find("out of memory") == std::string::npos) << program.err();
  }
  EXPECT_GT(incomplete, 0u);
}

/// The limit is reached while mapping; there may be no room for the grid of the results either.
TEST_F(HybridSlamMemory, WhereTheMemoryEndsThereAreResults) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers need their address space";
#endif
  const std::string path = northEast(30, 60, 0.2);
  for (const int megabytes : {560, 600, 640}) {
    SCOPED_TRACE(megabytes);
    fs::remove_all(output);
    test::ChildProgram program(
        folder, "run",
        {"/bin/sh", "-c",
         "ulimit -v " + std::to_string(1024 * megabytes) + "; exec '" HYBRID_SLAM "' -q -o '" + output +
             "' '" + path + "' --set grid.resolution=0.02"});
    EXPECT_EQ(program.wait(), 1);
    EXPECT_THAT(program.err(), HasSubstr("results cover the log up to this point"));
    EXPECT_FALSE(files::loadTum(output + "/trajectory.tum").empty());
  }
}

TEST_F(HybridSlamMemory, PeakMemoryIsThatOfTheProgramAlone) {
  const std::string log = test::writeGzipped(folder.path("log.rawlog"), test::laps(10));
  {
    const std::vector<char> large(700 << 20, 'x');  // resident in the process that starts it
    ASSERT_EQ(large.back(), 'x');
    test::ChildProgram program(folder, "run", {HYBRID_SLAM, "-q", "-o", output, ini, log});
    EXPECT_EQ(program.wait(), 0);
  }
  EXPECT_LT(nlohmann::json::parse(result("metrics.json"))["peak_rss_mb"], 700);
}

TEST_F(HybridSlamMemory, MemoryDoesNotGrowWithTheLogOfTheSamePlace) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "AddressSanitizer keeps freed memory";
#endif
  const auto peakOf = [this](size_t steps) {
    EXPECT_EQ(replay(test::laps(steps), "-q -n 20"), 0) << err;
    return nlohmann::json::parse(result("metrics.json"))["peak_rss_mb"].get<double>();
  };
  const double once = peakOf(800), twice = peakOf(1600);
  EXPECT_LT(twice, 1.1 * once) << once << " MB, then " << twice << " MB";
  RecordProperty("peak_rss_mb", std::to_string(once) + ", " + std::to_string(twice));
}

}  // namespace
}  // namespace hybrid_slam
