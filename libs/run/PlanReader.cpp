// Reads floor plans.
#include <mrpt/system/string_utils.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "base/Errors.h"
#include "files/InputFile.h"
#include "run/PlanFiles.h"
#include "run/PlanLines.h"

namespace hybrid_slam::run {
namespace {

using mrpt::math::TPoint2D;
using PlanJson = nlohmann::json;

constexpr size_t kMostPlanBytes = size_t{16} << 20;
constexpr char kExpectedPlan[] = "expected a floor plan: .geojson, .dxf, or .svg of hybrid-slam";

// GeoJSON

TPoint2D pointOf(const PlanJson& json) { return {json.at(0).get<double>(), json.at(1).get<double>()}; }

/// Adds a string of points, or the strings that the parts contain: rings of polygons, lines.
void addStrings(const PlanJson& coordinates, PlanLines& lines) {
  if (coordinates.empty()) return;
  if (coordinates.at(0).empty() || !coordinates.at(0).at(0).is_number()) {
    for (const PlanJson& part : coordinates) addStrings(part, lines);
    return;
  }
  for (size_t i = 1; i < coordinates.size(); ++i)
    lines.add(pointOf(coordinates.at(i - 1)), pointOf(coordinates.at(i)));
}

void addGeometry(const PlanJson& geometry, PlanLines& lines) {
  const std::string type = geometry.at("type");
  if (type == "GeometryCollection")
    for (const PlanJson& part : geometry.at("geometries")) addGeometry(part, lines);
  else if (type != "Point" && type != "MultiPoint")
    addStrings(geometry.at("coordinates"), lines);
}

void readGeoJson(const std::string& text, PlanLines& lines) {
  // Anything nested deeper is not GeoJSON, and would overflow the stack.
  const PlanJson json = PlanJson::parse(text, [](int depth, PlanJson::parse_event_t, PlanJson&) {
    if (depth > 20) throw std::runtime_error("nested too deeply");
    return true;
  });
  for (const PlanJson& feature : json.at("features")) {
    const PlanJson& properties = feature.contains("properties") ? feature["properties"] : PlanJson();
    if (properties.is_object() && properties.value("kind", PlanJson("wall")) == PlanJson("opening")) continue;
    if (feature.at("geometry").is_object()) addGeometry(feature["geometry"], lines);
  }
}

// SVG, as savePlanSvg writes it

double attribute(const std::string& element, const std::string& name) {
  const std::string before = " " + name + "=\"";
  const size_t at = element.find(before);
  double value = 0;
  std::istringstream in(at == std::string::npos ? "" : element.substr(at + before.size()));
  if (!(in >> value)) throw std::runtime_error("no attribute " + name + ": " + element);
  return value;
}

void readSvg(const std::string& text, PlanLines& lines) {
  const size_t begin = text.find("<g id=\"walls\"");
  if (begin == std::string::npos) throw std::runtime_error("no group `walls`");
  const size_t end = text.find("</g>", begin);
  std::istringstream in(text.substr(begin, end - begin));
  for (std::string row; std::getline(in, row);) {
    if (row.rfind("<line", 0) != 0) continue;
    lines.add({attribute(row, "x1"), attribute(row, "y1")}, {attribute(row, "x2"), attribute(row, "y2")});
  }
}

bool endsWith(const std::string& file, const std::string& end) {
  return file.size() >= end.size() && file.compare(file.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

std::vector<PlanLine> planOf(const std::string& text, const std::string& file) {
  PlanLines lines(file);
  const std::string name = mrpt::system::lowerCase(file);
  try {
    if (endsWith(name, ".dxf"))
      readPlanDxf(text, lines);
    else if (endsWith(name, ".svg"))
      readSvg(text, lines);
    else
      readGeoJson(text, lines);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& e) {
    throw InputError("not a floor plan: " + std::string(e.what()), file, kExpectedPlan);
  }
  if (lines.all().empty()) throw InputError("floor plan without walls", file, kExpectedPlan);
  return lines.all();
}

std::vector<PlanLine> loadPlan(const std::string& file) {
  files::expectFile(file, kExpectedPlan);
  std::ifstream in(file, std::ios::binary);
  std::string text(kMostPlanBytes + 1, '\0');
  if (!in) throw InputError("cannot read the floor plan", file, kExpectedPlan);
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<size_t>(in.gcount()));
  if (text.size() > kMostPlanBytes) throw InputError("floor plan of over 16 MiB", file, kExpectedPlan);
  return planOf(text, file);
}

}  // namespace hybrid_slam::run
