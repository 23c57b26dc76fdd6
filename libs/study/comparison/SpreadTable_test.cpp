#include "study/comparison/SpreadTable.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "files/TemporaryFolder.h"
#include "testing/CommaLocale.h"

namespace hybrid_slam::comparison {
namespace {

const char* const kHeader =
    "timestamp,particles,ess,resampled,std_x,std_y,std_phi,std_along,std_across,w_grid_best,w_line_best,"
    "lines_seen,lines_matched,step_ms\n";

TEST(SpreadTable, ReadsItsColumnsByNameAndSkipsTheFirstScan) {
  const files::TemporaryFolder folder;
  const auto file = folder.write("steps.csv", std::string(kHeader) +
                                                  "10.5,20,1,0,0,0,0,0,0,,,0,0,7\n"
                                                  "11.5,20,0.5,1,0.1,0.2,0.0174532925,0.3,0.4,0.7,,5,4,9\n"
                                                  "12.5,20,0.5,,0.1,0.2,0,0.5,0.2,0.7,,5,4,9\n");
  const auto steps = loadSpread(file);
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_EQ(steps[0].timestamp, 11.5);
  EXPECT_EQ(steps[0].spread[0], 0.3);
  EXPECT_EQ(steps[0].spread[1], 0.4);
  EXPECT_NEAR(steps[0].spread[2], 1, 1e-8);
  EXPECT_EQ(steps[0].spread[3], 0.1);
  EXPECT_EQ(steps[0].spread[4], 0.2);
  const Spread mean = meanSpread(steps);
  EXPECT_NEAR(mean[0], 0.4, 1e-12);
  EXPECT_NEAR(mean[1], 0.3, 1e-12);
  EXPECT_NEAR(mean[2], 0.5, 1e-8);
}

TEST(SpreadTable, IsReadTheSameInEveryLocale) {
  const test::CommaLocale german;
  const files::TemporaryFolder folder;
  const auto steps = loadSpread(
      folder.write("steps.csv", std::string(kHeader) + "10.5,20,1,0,0,0,0,0,0,,,0,0,7\n"
                                                       "11.5,20,0.5,1,0.1,0.2,0,0.3,0.4,0.7,,5,4,9\n"));
  ASSERT_EQ(steps.size(), 1u);
  EXPECT_EQ(steps[0].timestamp, 11.5);
  EXPECT_EQ(steps[0].spread[0], 0.3);
}

TEST(SpreadTable, ABrokenTableIsAnError) {
  const files::TemporaryFolder folder;
  EXPECT_THROW(loadSpread(folder.path("none.csv")), std::runtime_error);
  const std::string huge = folder.write("huge", kHeader);
  std::filesystem::resize_file(huge, uintmax_t{1} << 40);  // which must not be read as one line
  EXPECT_THROW(loadSpread(huge), std::runtime_error);
  EXPECT_THROW(loadSpread(folder.write("a", "timestamp,particles\n1,20\n")), std::runtime_error);
  EXPECT_THROW(loadSpread(folder.write("b", std::string(kHeader) + "1,20,0.5,1,0.1\n")), std::runtime_error);
  EXPECT_THROW(loadSpread(folder.write("c", std::string(kHeader) + "1,20,0.5,1,0.1,x,y,z,0,0,0,0,0,0\n")),
               std::runtime_error);
}

TEST(SpreadBands, ARunContributesItsLastUpdate) {
  const std::vector<SpreadStep> early{{100, {1, 10, 0}}, {102, {3, 30, 0}}},
      late{{101, {5, 50, 0}}, {104, {7, 70, 0}}};
  const SpreadBands bands = spreadBands({early, late}, 5);  // at 100, 101 ... 104 s
  ASSERT_EQ(bands.times, (std::vector<double>{0, 1, 2, 3, 4}));
  const double medians[] = {1, 3, 4, 4, 5};
  for (size_t i = 0; i < 5; ++i) {
    EXPECT_DOUBLE_EQ(bands.bands[0][i].median, medians[i]);
    EXPECT_DOUBLE_EQ(bands.bands[1][i].median, 10 * medians[i]);
  }
  EXPECT_DOUBLE_EQ(bands.bands[0][1].lower, 2);
  EXPECT_DOUBLE_EQ(bands.bands[0][1].upper, 4);
}

TEST(SpreadBands, NoRunsGiveNoTimes) {
  EXPECT_TRUE(spreadBands({}, 5).times.empty());
  EXPECT_TRUE(spreadBands({{}, {}}, 5).times.empty());
}

}  // namespace
}  // namespace hybrid_slam::comparison
