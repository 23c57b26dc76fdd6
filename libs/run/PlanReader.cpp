// Reads floor plans.
#include <dxflib/dl_creationadapter.h>
#include <dxflib/dl_dxf.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "base/Errors.h"
#include "run/PlanFiles.h"

namespace hybrid_slam::run {
namespace {

using mrpt::math::TPoint2D;
using Json = nlohmann::json;

constexpr size_t kMostBytes = size_t{64} << 20;
constexpr size_t kLongestLine = 1000;  // bytes; dxflib cuts longer ones
constexpr double kFarthest = 1e6;      // m

class Lines {
 public:
  explicit Lines(const std::string& file) : file_(file) {}
  void add(const TPoint2D& a, const TPoint2D& b) {
    for (const double value : {a.x, a.y, b.x, b.y})
      if (!(std::abs(value) <= kFarthest))
        throw InputError("impossible coordinate in a floor plan", file_, "expected metres, at most 1e6");
    const double length = (b - a).norm();
    if (length <= 1e-6) return;
    checkPlanLength(length_ += length, file_);
    all.push_back({a, b});
  }
  std::vector<PlanLine> all;

 private:
  const std::string& file_;
  double length_ = 0;
};

// GeoJSON

TPoint2D pointOf(const Json& json) { return {json.at(0).get<double>(), json.at(1).get<double>()}; }

void addString(const Json& points, Lines& lines) {
  for (size_t i = 1; i < points.size(); ++i) lines.add(pointOf(points.at(i - 1)), pointOf(points.at(i)));
}

void addGeometry(const Json& geometry, Lines& lines) {
  const std::string type = geometry.at("type");
  if (type == "LineString") addString(geometry.at("coordinates"), lines);
  if (type == "MultiLineString" || type == "Polygon")
    for (const Json& part : geometry.at("coordinates")) addString(part, lines);
}

void readGeoJson(const std::string& text, Lines& lines) {
  // Anything nested deeper is no GeoJSON, and would use up the stack.
  const Json json = Json::parse(text, [](int depth, Json::parse_event_t, Json&) {
    if (depth > 20) throw std::runtime_error("nested too deeply");
    return true;
  });
  for (const Json& feature : json.at("features")) {
    const Json& properties = feature.contains("properties") ? feature["properties"] : Json();
    if (properties.is_object() && properties.value("kind", Json("wall")) == Json("opening")) continue;
    if (feature.at("geometry").is_object()) addGeometry(feature["geometry"], lines);
  }
}

// DXF

/// m of the unit $INSUNITS; without unit: metres.
double metresOf(int unit) {
  switch (unit) {
    case 1:
      return 0.0254;
    case 2:
      return 0.3048;
    case 4:
      return 0.001;
    case 5:
      return 0.01;
    case 14:
      return 0.1;
    default:
      return 1;
  }
}

class DxfLines : public DL_CreationAdapter {
 public:
  explicit DxfLines(Lines& lines) : lines_(lines) {}
  void setVariableInt(const std::string& key, int value, int) override {
    if (key == "$INSUNITS") metre_ = metresOf(value);
  }
  void addLine(const DL_LineData& line) override { add({line.x1, line.y1}, {line.x2, line.y2}); }
  void addPolyline(const DL_PolylineData& polyline) override {
    isClosed_ = (polyline.flags & 1) != 0;
    first_.reset();
  }
  void addVertex(const DL_VertexData& vertex) override {
    const TPoint2D p(vertex.x, vertex.y);
    if (first_)
      add(last_, p);
    else
      first_ = p;
    last_ = p;
  }
  void endEntity() override { close(); }
  void endSequence() override { close(); }

 private:
  void close() {
    if (first_ && isClosed_) add(last_, *first_);
    first_.reset();
  }
  void add(const TPoint2D& a, const TPoint2D& b) {
    if (attributes.getLayer() != "OPENINGS") lines_.add(a * metre_, b * metre_);
  }

  Lines& lines_;
  double metre_ = 1;
  bool isClosed_ = false;
  std::optional<TPoint2D> first_;
  TPoint2D last_;
};

void readDxf(const std::string& text, Lines& lines) {
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    if (line.size() > kLongestLine) throw std::runtime_error("a line of over 1000 characters");
  in.clear();
  in.seekg(0);
  DxfLines reader(lines);
  DL_Dxf dxf;
  if (!dxf.in(in, &reader)) throw std::runtime_error("not readable");
}

// SVG, as savePlanSvg writes it

void readSvg(const std::string& text, Lines& lines) {
  const size_t begin = text.find("<g id=\"walls\"");
  if (begin == std::string::npos) throw std::runtime_error("no group `walls`");
  const size_t end = text.find("</g>", begin);
  std::istringstream in(text.substr(begin, end - begin));
  for (std::string row; std::getline(in, row);) {
    if (row.rfind("<line", 0) != 0) continue;
    std::istringstream numbers(row);
    double value[4];
    for (double& each : value) {
      numbers.ignore(row.size(), '"');
      numbers >> each;
      numbers.ignore(row.size(), '"');
    }
    if (!numbers) throw std::runtime_error("not a line: " + row);
    lines.add({value[0], value[1]}, {value[2], value[3]});
  }
}

bool endsWith(const std::string& file, const std::string& end) {
  return file.size() >= end.size() && file.compare(file.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

void checkPlanLength(double length, const std::string& file) {
  constexpr double kMost = 3e5;  // m
  if (!(length <= kMost)) throw InputError("walls of over 300 km", file, "expected a floor plan in metres");
}

std::vector<PlanLine> loadPlan(const std::string& file) {
  const std::string expected = "expected a floor plan: .geojson, .dxf, or .svg of hybrid-slam";
  std::ifstream in(file, std::ios::binary);
  std::string text(kMostBytes + 1, '\0');
  if (!in) throw InputError("cannot read the floor plan", file, expected);
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<size_t>(in.gcount()));
  if (text.size() > kMostBytes) throw InputError("floor plan of over 64 MiB", file, expected);
  Lines lines(file);
  try {
    if (endsWith(file, ".dxf"))
      readDxf(text, lines);
    else if (endsWith(file, ".svg"))
      readSvg(text, lines);
    else
      readGeoJson(text, lines);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& e) {
    throw InputError("not a floor plan: " + std::string(e.what()), file, expected);
  }
  if (lines.all.empty()) throw InputError("floor plan without walls", file, expected);
  return std::move(lines.all);
}

}  // namespace hybrid_slam::run
