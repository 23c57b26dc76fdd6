/// slam-compare without true poses: relations and revisits as in slam-eval, and the success criterion.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "SlamCompareProgram.h"
#include "files/Trajectory.h"
#include "testing/TestLogs.h"

namespace hybrid_slam {
namespace {

using test::contentOf;
using test::Outcome;
using testing::HasSubstr;

struct SlamCompareSuccess : SlamCompare {};

TEST_F(SlamCompareSuccess, TheRelationsMetricIsSlamEvalsAndDecidesSuccess) {
  const files::Trajectory truth = files::loadTum(kCsie + "csie-corridor.tum");
  std::ostringstream relations;
  relations.precision(15);
  for (size_t i = 0; i + 60 < truth.size(); i += 20) {
    const auto motion = truth[i + 60].pose - truth[i].pose;
    relations << std::fixed << truth[i].timestamp << ' ' << truth[i + 60].timestamp << ' ' << motion.x << ' '
              << motion.y << " 0 0 0 " << motion.phi << '\n';
  }
  folder.write("truth.relations", relations.str());
  ASSERT_EQ(run("--methods general --seeds 1 -q --relations truth.relations").status, 0);
  const Outcome eval =
      shell(std::string("'") + SLAM_EVAL +
            "' relations --trajectory out/runs/general-3-1/trajectory.tum --relations truth.relations");
  ASSERT_EQ(eval.status, 0) << eval.err;
  const auto json = nlohmann::json::parse(eval.out);
  const auto row = table("results.csv").at(0);
  EXPECT_NEAR(std::stod(row.at("trans_mean_m")), json.at("trans_mean_m"),
              1e-5 * json.at("trans_mean_m").get<double>());
  EXPECT_NEAR(std::stod(row.at("rot_mean_deg")), json.at("rot_mean_deg"),
              1e-5 * json.at("rot_mean_deg").get<double>());

  for (const std::string share : {"1.01", "0.99"}) {
    const std::string bound = std::to_string(std::stod(share) * json.at("trans_mean_m").get<double>());
    ASSERT_EQ(
        run("--methods general --seeds 1 -q --relations truth.relations --success-relations " + bound).status,
        0);
    EXPECT_EQ(table("results.csv").at(0).at("success"), share == "1.01" ? "1" : "0");
  }
  EXPECT_THAT(test::contentOf(folder.path("out/report.html")),
              HasSubstr("mean translation error of the relations is"));
}

TEST_F(SlamCompareSuccess, TheRevisitErrorIsSlamEvalsAndDecidesSuccess) {
  test::writeGzipped(folder.path("laps.rawlog"), test::laps(240));
  const std::string compare = std::string("'") + SLAM_COMPARE + "' " + config +
                              " laps.rawlog -o out --methods general --seeds 1 -q --revisits 2.5 ";
  ASSERT_EQ(shell(compare).status, 0);
  const Outcome eval = shell(
      std::string("'") + SLAM_EVAL +
      "' revisits --trajectory out/runs/general-3-1/trajectory.tum --rawlog laps.rawlog --distance 2.5");
  ASSERT_EQ(eval.status, 0) << eval.err;
  const auto json = nlohmann::json::parse(eval.out);
  const auto row = table("results.csv").at(0);
  const double error = json.at("median_m");
  EXPECT_NEAR(std::stod(row.at("revisit_median_m")), error, 1e-5 * error);
  EXPECT_EQ(std::stoi(row.at("revisits")), json.at("revisits"));
  EXPECT_EQ(row.at("success"), error < 0.07 ? "1" : "0");

  for (const std::string share : {"1.01", "0.99"}) {
    ASSERT_EQ(shell(compare + "--success-revisit " + std::to_string(std::stod(share) * error)).status, 0);
    EXPECT_EQ(table("results.csv").at(0).at("success"), share == "1.01" ? "1" : "0");
  }
  const std::string report = this->report();
  EXPECT_THAT(report, HasSubstr("scans revisit earlier ones, up to 2.5 m apart"));
  EXPECT_THAT(report, HasSubstr("revisit error, median (m)"));
}

TEST_F(SlamCompareSuccess, WithoutARevisitThereIsNoErrorAndNoSuccess) {
  test::writeGzipped(folder.path("laps.rawlog"), test::laps(80));
  const Outcome o = shell(std::string("'") + SLAM_COMPARE + "' " + config +
                          " laps.rawlog -o out --methods general --seeds 1 -q --revisits 3");
  ASSERT_EQ(o.status, 0) << o.err;
  const auto row = table("results.csv").at(0);
  EXPECT_EQ(row.at("revisit_median_m"), "");
  EXPECT_EQ(row.at("revisits"), "0");
  EXPECT_EQ(row.at("success"), "0");
}

TEST_F(SlamCompareSuccess, EveryCriterionThatAppliesMustHold) {
  folder.write("truth.relations", "1287388800.0 1287388801.0 0 0 0 0 0 0\n");  // any motion is an error
  const std::string reference = "--methods general --seeds 1 -q --reference " + kCsie +
                                "csie-corridor.tum --success-trans 99 --success-rot 180";
  const auto success = [&](const std::string& arguments) {
    EXPECT_EQ(run(reference + arguments).status, 0);
    return table("results.csv").at(0).at("success");
  };
  EXPECT_EQ(success(""), "1");
  EXPECT_EQ(success(" --relations truth.relations --success-relations 99"), "1");
  EXPECT_EQ(success(" --relations truth.relations --success-relations 1e-9"), "0");
}

}  // namespace
}  // namespace hybrid_slam
