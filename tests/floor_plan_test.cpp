// The floor plan of the simulated CSIE building, from log to comparison.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "Shell.h"
#include "files/TemporaryFolder.h"

namespace hybrid_slam {
namespace {

nlohmann::json errorsOf(const files::TemporaryFolder& folder, const std::string& plan,
                        const std::string& truth) {
  const std::string data = SOURCE_DIR "/datasets/csie/";
  const test::Outcome o =
      test::shell(folder, "'" SLAM_EVAL "' plan --align --plan " + plan + " --truth " + truth + " --rawlog " +
                              data + "csie-loop.rawlog --reference " + data + "csie-loop.tum");
  EXPECT_EQ(o.status, 0) << o.err;
  return nlohmann::json::parse(o.out);
}

TEST(FloorPlanOfCsie, WallsAreFoundToACentimetre) {
  const files::TemporaryFolder folder;
  const test::Outcome o =
      test::shell(folder, "'" HYBRID_SLAM "' -q -o out " SOURCE_DIR "/datasets/csie/csie-loop.rawlog");
  ASSERT_EQ(o.status, 0) << o.err;
  for (const char* format : {"geojson", "dxf", "svg"}) {
    const nlohmann::json errors =
        errorsOf(folder, std::string("out/plan.") + format, SOURCE_DIR "/datasets/csie/csie.plan");
    EXPECT_GE(errors.at("found_of_seen_percent"), 97) << format;
    EXPECT_LE(errors.at("false_percent"), 1) << format;
    EXPECT_LE(errors.at("median_distance_m"), 0.02) << format;
    EXPECT_LE(errors.at("median_angle_deg"), 0.1) << format;
  }
}

}  // namespace
}  // namespace hybrid_slam
