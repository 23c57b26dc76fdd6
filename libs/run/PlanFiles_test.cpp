#include "run/PlanFiles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "base/Errors.h"
#include "files/TemporaryFolder.h"

namespace hybrid_slam::run {
namespace {

using testing::HasSubstr;

struct PlanFiles : testing::Test {
  files::TemporaryFolder temporary;

  FloorPlan plan() const {
    FloorPlan result;
    for (const auto& [x0, y0, x1, y1] :
         {std::array<double, 4>{0, 0, 3, 0}, {4.0625, 0, 7, 0}, {-1.5, -2, -1.5, 1e3}}) {
      Wall wall;
      wall.start = {x0, y0}, wall.end = {x1, y1};
      const auto d = wall.end - wall.start;
      wall.line = lineThrough((wall.start + wall.end) * 0.5, std::atan2(d.y, d.x), d.norm(), 0.01);
      result.walls.push_back(wall);
    }
    result.openings.push_back({{3, 0}, {4.0625, 0}});
    return result;
  }
  std::vector<PlanLine> load(const std::string& name, const std::string& text) const {
    temporary.write(name, text);
    return loadPlan(temporary.path(name));
  }
  std::string errorOf(const std::string& name, const std::string& text) const {
    try {
      load(name, text);
    } catch (const InputError& e) {
      return e.what();
    }
    return "no error";
  }
};

TEST_F(PlanFiles, EachFormatIsReadBack) {
  const FloorPlan written = plan();
  savePlan(files::OutputFolder(temporary.path("out")), written);
  for (const char* name : {"out/plan.svg", "out/plan.dxf", "out/plan.geojson"}) {
    const std::vector<PlanLine> read = loadPlan(temporary.path(name));
    ASSERT_EQ(read.size(), 3u) << name;
    for (size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR((read[i].start - written.walls[i].start).norm(), 0, 1e-4) << name;
      EXPECT_NEAR((read[i].end - written.walls[i].end).norm(), 0, 1e-4) << name;
    }
  }
}

TEST_F(PlanFiles, AnEmptyPlanIsWrittenButNotRead) {
  savePlan(files::OutputFolder(temporary.path("out")), FloorPlan());
  for (const char* name : {"out/plan.svg", "out/plan.dxf", "out/plan.geojson"})
    EXPECT_THROW(loadPlan(temporary.path(name)), InputError) << name;
}

TEST_F(PlanFiles, GeoJsonHoldsTheCovarianceAtTheMiddleOfTheWall) {
  FloorPlan one = plan();
  one.walls.resize(1);
  one.walls[0].line.at = {0, 0};  // 1.5 m before the middle
  one.walls[0].line.covariance << 1e-4, 0, 0, 1e-6;
  savePlanGeoJson(files::OutputFolder(temporary.path("out")), one);
  std::ifstream in(temporary.path("out/plan.geojson"));
  const auto json = nlohmann::json::parse(in);
  const auto& covariance = json["features"][0]["properties"]["covariance"];
  EXPECT_NEAR(covariance[0][0], 1e-4 + 1.5 * 1.5 * 1e-6, 1e-12);
  EXPECT_NEAR(covariance[0][1], 1.5e-6, 1e-12);
  EXPECT_NEAR(covariance[1][1], 1e-6, 1e-15);
  EXPECT_EQ(json["features"][1]["properties"]["kind"], "opening");
}

TEST_F(PlanFiles, DxfOfOthersHasPolylinesAndUnits) {
  const std::string text =
      "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n"
      "0\nLWPOLYLINE\n8\n0\n90\n3\n70\n1\n10\n0\n20\n0\n10\n4000\n20\n0\n10\n4000\n20\n3000\n"
      "0\nLINE\n8\n0\n10\n0\n20\n0\n11\n1000\n21\n0\n0\nENDSEC\n0\nEOF\n";
  const std::vector<PlanLine> lines = load("others.dxf", text);
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_NEAR(lines[0].end.x, 4, 1e-9);
  EXPECT_NEAR(lines[2].start.y, 3, 1e-9);  // closed
  EXPECT_NEAR(lines[2].end.y, 0, 1e-9);
  EXPECT_NEAR(lines[3].end.x, 1, 1e-9);
}

TEST_F(PlanFiles, GeoJsonOfOthersHasPolygons) {
  EXPECT_EQ(
      load("a.geojson", R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":null,)"
                        R"("geometry":{"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,0]]]}}]})")
          .size(),
      3u);
}

TEST_F(PlanFiles, WhatIsNoPlanIsAnInputError) {
  EXPECT_THROW(loadPlan(temporary.path("missing.dxf")), InputError);
  EXPECT_THAT(errorOf("a.geojson", "{"), HasSubstr("not a floor plan"));
  EXPECT_THAT(errorOf("a.geojson", "{}"), HasSubstr("not a floor plan"));
  EXPECT_THAT(errorOf("a.geojson", std::string(100000, '[')), HasSubstr("not a floor plan"));
  EXPECT_THAT(errorOf("a.geojson",
                      R"({"features":[{"geometry":{"type":"LineString","coordinates":[[0,0],[1e9,0]]}}]})"),
              HasSubstr("impossible coordinate"));
  EXPECT_THAT(errorOf("a.geojson",
                      R"({"features":[{"geometry":{"type":"LineString","coordinates":[[0,0],[4e5,0]]}}]})"),
              HasSubstr("walls of over 300 km"));
  EXPECT_THAT(errorOf("a.svg", "<svg/>"), HasSubstr("not a floor plan"));
  EXPECT_THAT(errorOf("a.svg", "<g id=\"walls\">\n<line x1=\"a\"/>\n</g>"), HasSubstr("not a floor plan"));
  EXPECT_THAT(errorOf("a.dxf", std::string(5000, 'x')), HasSubstr("not a floor plan"));
  EXPECT_THAT(errorOf("a.dxf", "0\nEOF\n"), HasSubstr("without walls"));
  EXPECT_THAT(errorOf("a.dxf", ""), HasSubstr("without walls"));
}

}  // namespace
}  // namespace hybrid_slam::run
