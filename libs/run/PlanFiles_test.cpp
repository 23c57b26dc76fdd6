#include "run/PlanFiles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "base/Errors.h"
#include "files/TemporaryFolder.h"
#include "testing/ErrorOf.h"

namespace hybrid_slam::run {
namespace {

using testing::HasSubstr;

struct PlanFiles : testing::Test {
  files::TemporaryFolder temporary;

  FloorPlan plan() const {
    FloorPlan result;
    for (const auto& [x0, y0, x1, y1] :
         {std::array<double, 4>{0, 0, 3, 0}, {4.0625, 0, 7, 0}, {-1.5, -2, -1.5, 1e3}}) {
      PlanWall wall;
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
  std::string textOf(const std::string& name) const {
    std::ifstream in(temporary.path(name));
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::string errorOf(const std::string& name, const std::string& text) const {
    return test::errorOf([&] { load(name, text); });
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

TEST_F(PlanFiles, EachFormatHoldsTheCovarianceAtTheMiddleOfTheWall) {
  FloorPlan one = plan();
  one.walls.resize(1);
  one.walls[0].line.at = {0, 0};  // 1.5 m before the middle
  one.walls[0].line.covariance << 1e-4, 0, 0, 1e-6;
  savePlan(files::OutputFolder(temporary.path("out")), one);
  std::ifstream in(temporary.path("out/plan.geojson"));
  const auto json = nlohmann::json::parse(in);
  const auto& covariance = json["features"][0]["properties"]["covariance"];
  EXPECT_NEAR(covariance[0][0], 1e-4 + 1.5 * 1.5 * 1e-6, 1e-12);
  EXPECT_NEAR(covariance[0][1], 1.5e-6, 1e-12);
  EXPECT_NEAR(covariance[1][1], 1e-6, 1e-15);
  EXPECT_EQ(json["features"][1]["properties"]["kind"], "opening");
  EXPECT_THAT(textOf("out/plan.svg"), HasSubstr("y2=\"0\" data-covariance=\"0.0001023 1.5e-06 1e-06\"/>"));
  EXPECT_THAT(textOf("out/plan.dxf"), HasSubstr("APPID\n  2\nHYBRID_SLAM\n"));
  EXPECT_THAT(textOf("out/plan.dxf"), HasSubstr("1001\nHYBRID_SLAM\n1000\n"));
  EXPECT_THAT(textOf("out/plan.dxf"), HasSubstr("\n1040\n0.00010225\n1040\n0.0000015\n1040\n0.000001\n"));
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

/// A flat entity whose extrusion points down is mirrored; a LINE is not flat.
TEST_F(PlanFiles, DxfOfOthersHasMirroredEntities) {
  const std::string down = "210\n0\n220\n0\n230\n-1\n";
  const std::vector<PlanLine> lines =
      load("MIRRORED.DXF",
           "0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n8\n0\n90\n2\n70\n0\n10\n1\n20\n2\n10\n4\n20\n2\n" + down +
               "0\nPOLYLINE\n8\n0\n70\n0\n" + down +
               "0\nVERTEX\n8\n0\n10\n1\n20\n2\n0\nVERTEX\n8\n0\n10\n4\n20\n2\n0\nSEQEND\n" +
               "0\nLINE\n8\n0\n10\n-1\n20\n2\n11\n-4\n21\n2\n" + down + "0\nENDSEC\n0\nEOF\n");
  ASSERT_EQ(lines.size(), 3u);
  for (const PlanLine& line : lines) {
    EXPECT_NEAR(line.start.x, -1, 1e-9);
    EXPECT_NEAR(line.end.x, -4, 1e-9);
    EXPECT_NEAR(line.end.y, 2, 1e-9);
  }
}

TEST_F(PlanFiles, DxfInEveryUnitIsReadInMetres) {
  const auto lengthIn = [this](const std::string& unit) {
    const std::vector<PlanLine> lines =
        load("unit.dxf", "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n" + unit +
                             "\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n"
                             "0\nLINE\n8\n0\n10\n0\n20\n0\n11\n50\n21\n0\n0\nENDSEC\n0\nEOF\n");
    return lines.at(0).end.x;
  };
  EXPECT_NEAR(lengthIn("0"), 50, 1e-9);
  EXPECT_NEAR(lengthIn("1"), 1.27, 1e-9);    // inches
  EXPECT_NEAR(lengthIn("10"), 45.72, 1e-9);  // yards
  EXPECT_NEAR(lengthIn("16"), 5000, 1e-6);   // hectometres
  EXPECT_THAT(errorOf("light-years.dxf", "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n19\n0\nENDSEC\n0\nEOF\n"),
              HasSubstr("unknown unit, $INSUNITS 19"));
}

/// The semicircle from (0, 0) to (2, 0) below the chord is given by a bulge of 1, by an arc, and as half of a
/// circle.
TEST_F(PlanFiles, DxfOfOthersHasArcs) {
  const std::string head = "0\nSECTION\n2\nENTITIES\n", tail = "0\nENDSEC\n0\nEOF\n";
  const auto polyline = load(
      "bulge.dxf", head + "0\nLWPOLYLINE\n8\n0\n90\n2\n70\n0\n10\n0\n20\n0\n42\n1\n10\n2\n20\n0\n" + tail);
  const auto arc = load("arc.dxf", head + "0\nARC\n8\n0\n10\n1\n20\n0\n40\n1\n50\n180\n51\n360\n" + tail);
  ASSERT_EQ(polyline.size(), 18u);
  ASSERT_EQ(arc.size(), 18u);
  for (size_t i = 0; i < 18; ++i) {
    for (const PlanLine& line : {polyline[i], arc[i]}) {
      EXPECT_NEAR(std::hypot(line.start.x - 1, line.start.y), 1, 1e-9);
      EXPECT_LE(line.end.y, 1e-9);
      EXPECT_NEAR((line.end - line.start).norm(), 2 * std::sin(M_PI / 36), 1e-9);
    }
    EXPECT_NEAR((polyline[i].start - arc[i].start).norm(), 0, 1e-9);
  }
  EXPECT_EQ(load("circle.dxf", head + "0\nCIRCLE\n8\n0\n10\n1\n20\n0\n40\n1\n" + tail).size(), 36u);
}

/// The counts and angles are those of a hostile or broken DXF.
TEST_F(PlanFiles, CountsAndAnglesOfADxfAreNotBelieved) {
  const std::string head = "0\nSECTION\n2\nENTITIES\n", tail = "0\nENDSEC\n0\nEOF\n";
  EXPECT_THAT(errorOf("a.dxf", head + "0\nLWPOLYLINE\n8\n0\n90\n1073741825\n" + tail),
              HasSubstr("without walls"));
  EXPECT_THAT(errorOf("a.dxf", head + "0\nLEADER\n8\n0\n76\n1431655766\n" + tail),
              HasSubstr("without walls"));
  EXPECT_THAT(errorOf("a.dxf", head + "0\nARC\n8\n0\n10\n0\n20\n0\n40\n0\n50\n0\n51\n1.355e26\n" + tail),
              HasSubstr("without walls"));
  EXPECT_LE(load("a.dxf", head + "0\nARC\n8\n0\n10\n0\n20\n0\n40\n1\n50\n0\n51\n1e300\n" + tail).size(), 36u);
  EXPECT_THAT(errorOf("a.dxf", head + "0\nLINE\n8\n0\n10\nx\n" + tail),
              HasSubstr("line 9 of the DXF: expected a number"));
  std::string circles = head;
  for (int i = 0; i < 30'000; ++i) circles += "0\nCIRCLE\n40\n2e-5\n";
  EXPECT_THAT(errorOf("a.dxf", circles + tail), HasSubstr("over a million walls"));
}

TEST_F(PlanFiles, BlocksOfADxfAreNoWalls) {
  const std::string line = "0\nLINE\n8\n0\n10\n0\n20\n0\n11\n1\n21\n0\n";
  EXPECT_EQ(
      load("block.dxf", "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n8\n0\n2\ndoor\n10\n0\n20\n0\n30\n0\n" + line +
                            "0\nENDBLK\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" + line + "0\nENDSEC\n0\nEOF\n")
          .size(),
      1u);
}

TEST_F(PlanFiles, GeoJsonOfOthersHasPolygonsAndCollections) {
  const auto wallsOf = [this](const std::string& geometry) {
    return load("a.geojson", R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":null,)"
                             R"("geometry":)" +
                                 geometry + "}]}")
        .size();
  };
  const std::string polygon = R"({"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,0]],[]]})";
  const std::string two =
      R"({"type":"MultiPolygon","coordinates":[[[[0,0],[1,0],[1,1],[0,0]]],[[[5,0],[6,0],[6,1],[5,0]]]]})";
  EXPECT_EQ(wallsOf(polygon), 3u);
  EXPECT_EQ(wallsOf(two), 6u);
  EXPECT_EQ(wallsOf(R"({"type":"GeometryCollection","geometries":[{"type":"Point","coordinates":[0,0]},)" +
                    polygon + "," + two + "]}"),
            9u);
}

TEST_F(PlanFiles, SvgLinesAreReadByTheNamesOfTheirAttributes) {
  const auto walls =
      load("a.svg", "<g id=\"walls\">\n<line id=\"7\" y2=\"4\" x2=\"3\" y1=\"2\" x1=\"1\"/>\n</g>");
  ASSERT_EQ(walls.size(), 1u);
  EXPECT_EQ(walls[0].start, mrpt::math::TPoint2D(1, 2));
  EXPECT_EQ(walls[0].end, mrpt::math::TPoint2D(3, 4));
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
              HasSubstr("walls of over 30 km"));
  EXPECT_THAT(errorOf("a.svg", "<svg/>"), HasSubstr("not a floor plan"));
  EXPECT_THAT(errorOf("a.svg", "<g id=\"walls\">\n<line x1=\"a\"/>\n</g>"), HasSubstr("not a floor plan"));
  EXPECT_THAT(errorOf("a.dxf", std::string(5000, 'x')), HasSubstr("not a floor plan"));
  EXPECT_THAT(errorOf("a.dxf", "0\nEOF\n"), HasSubstr("without walls"));
  EXPECT_THAT(errorOf("a.dxf", ""), HasSubstr("without walls"));
}

}  // namespace
}  // namespace hybrid_slam::run
