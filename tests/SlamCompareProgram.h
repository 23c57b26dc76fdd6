/// @file SlamCompareProgram.h
/// @brief For the tests: runs slam-compare in a temporary folder.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "ResultFiles.h"
#include "Shell.h"
#include "files/TemporaryFolder.h"

namespace hybrid_slam {

inline const std::string kCsie = SOURCE_DIR "/datasets/csie/";
inline const std::string kLog = kCsie + "csie-corridor.rawlog";
inline const std::string kTruth =
    " --reference " + kCsie + "csie-corridor.tum --floorplan " + kCsie + "csie.plan";
inline const std::string kSmall = " --methods hybrid,general --particles 4 --seeds 2 -q";

struct SlamCompare : testing::Test {
  files::TemporaryFolder folder;
  std::string config = folder.write(
      "small.ini", "[particle_filter]\nparticles = 3\nproposal = standard\nupdate_distance = 1\n");

  test::Outcome shell(const std::string& command) const { return test::shell(folder, command); }
  std::string call(const std::string& arguments) const {
    return std::string("'") + SLAM_COMPARE + "' " + config + " " + kLog + " -o out " + arguments;
  }
  test::Outcome run(const std::string& arguments) const { return shell(call(arguments)); }
  /// Expects exit code 2, nothing on standard output and no run; returns the one line on standard error.
  std::string errorLine(const test::Outcome& o) const {
    test::expectInputError(o, "slam-compare", "");
    return o.err;
  }
  std::vector<std::string> runs() const { return test::namesIn(folder.path("out/runs")); }
  std::vector<std::map<std::string, std::string>> table(const std::string& name) const {
    const auto cells = test::csv(test::contentOf(folder.path("out/" + name)));
    std::vector<std::map<std::string, std::string>> rows;
    for (size_t row = 1; row < cells.size(); ++row) {
      EXPECT_EQ(cells[row].size(), cells[0].size()) << name << ", row " << row;
      rows.emplace_back();
      for (size_t i = 0; i < std::min(cells[row].size(), cells[0].size()); ++i)
        rows.back()[cells[0][i]] = cells[row][i];
    }
    return rows;
  }
  /// Returns report.html, which must be well-formed XML.
  std::string report() const {
    const test::Outcome parsed =
        shell("python3 -c 'import xml.dom.minidom as xml; xml.parse(\"out/report.html\")'");
    EXPECT_EQ(parsed.status, 0) << parsed.err;
    return test::contentOf(folder.path("out/report.html"));
  }
  /// Returns results.csv without the measured times.
  std::string untimedTable() const {
    std::string text;
    for (auto& row : table("results.csv"))
      for (const auto& [column, cell] : row)
        if (column != "wall_s" && column != "cpu_s" && column != "peak_rss_mb" && column != "realtime_factor")
          text += column + "=" + cell + " ";
    return text;
  }
};

}  // namespace hybrid_slam
