#include "run/PlanFiles.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

namespace hybrid_slam::run {
namespace {

using mrpt::math::TPoint2D;
using Json = nlohmann::ordered_json;

constexpr double kMargin = 1;  // m

/// Rounds a length (m) to 0.1 mm.
double rounded(double metres) { return std::round(metres * 1e4) / 1e4; }

struct Box {
  double x0 = std::numeric_limits<double>::infinity(), y0 = x0, x1 = -x0, y1 = -x0;
};

Box boxOf(const FloorPlan& plan) {
  Box box;
  for (const PlanWall& wall : plan.walls)
    for (const TPoint2D& p : {wall.start, wall.end})
      box = {std::min(box.x0, p.x), std::min(box.y0, p.y), std::max(box.x1, p.x), std::max(box.y1, p.y)};
  if (plan.walls.empty()) return {0, 0, 0, 0};
  return box;
}

void writeLine(std::ostream& out, const TPoint2D& a, const TPoint2D& b, const std::string& more = {}) {
  out << "<line x1=\"" << rounded(a.x) << "\" y1=\"" << rounded(a.y) << "\" x2=\"" << rounded(b.x)
      << "\" y2=\"" << rounded(b.y) << '"' << more << "/>\n";
}

std::string covarianceAttribute(const PlanWall& wall) {
  const Eigen::Matrix2d c = wall.covariance();
  std::ostringstream out;
  out << std::setprecision(4) << " data-covariance=\"" << c(0, 0) << ' ' << c(0, 1) << ' ' << c(1, 1) << '"';
  return out.str();
}

/// Writes the body of a wall between its faces.
void writeBody(std::ostream& out, const PlanWall& a, const PlanWall& b) {
  const double from = std::max(a.line.along(a.start), a.line.along(b.end));
  const double to = std::min(a.line.along(a.end), a.line.along(b.start));
  const TPoint2D p = a.line.point(from), q = a.line.point(to);
  const TPoint2D r = b.line.point(b.line.along(q)), s = b.line.point(b.line.along(p));
  out << "<path d=\"M";
  for (const TPoint2D& corner : {p, q, r, s}) out << ' ' << rounded(corner.x) << ' ' << rounded(corner.y);
  out << "Z\"/>\n";
}

Json point(const TPoint2D& p) { return {rounded(p.x), rounded(p.y)}; }

Json feature(const TPoint2D& a, const TPoint2D& b, Json properties) {
  return {{"type", "Feature"},
          {"geometry", {{"type", "LineString"}, {"coordinates", {point(a), point(b)}}}},
          {"properties", std::move(properties)}};
}

Json properties(const PlanWall& wall, size_t id) {
  const Eigen::Matrix2d c = wall.covariance();
  Json json{{"kind", "wall"},
            {"id", id},
            {"line", wall.group},
            {"length_m", rounded(wall.length())},
            {"observations", wall.count},
            {"snapped", wall.isSnapped},
            {"covariance", {{c(0, 0), c(0, 1)}, {c(1, 0), c(1, 1)}}}};
  if (wall.pair >= 0) json["other_face"] = wall.pair, json["thickness_m"] = rounded(wall.thickness);
  return json;
}

}  // namespace

void savePlanSvg(const files::OutputFolder& folder, const FloorPlan& plan) {
  const Box box = boxOf(plan);
  const double width = box.x1 - box.x0 + 2 * kMargin, height = box.y1 - box.y0 + 2 * kMargin;
  folder.write("plan.svg", [&](std::ostream& out) {
    out << std::setprecision(10);
    // 1 m is 1 cm on paper; y points up, as in the map.
    out << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << rounded(width) << "cm\" height=\""
        << rounded(height) << "cm\" viewBox=\"" << rounded(box.x0 - kMargin) << ' '
        << rounded(-box.y1 - kMargin) << ' ' << rounded(width) << ' ' << rounded(height)
        << "\">\n<desc>floor plan, metres in the map frame; data-covariance: m^2, m rad, rad^2</desc>\n"
        << "<rect x=\"" << rounded(box.x0 - kMargin) << "\" y=\"" << rounded(-box.y1 - kMargin)
        << "\" width=\"100%\" height=\"100%\" fill=\"white\"/>\n<g transform=\"scale(1,-1)\" fill=\"none\">\n"
        << "<g id=\"bodies\" fill=\"#999\">\n";
    for (size_t i = 0; i < plan.walls.size(); ++i) {
      const int other = plan.walls[i].pair;
      if (other > static_cast<int>(i)) writeBody(out, plan.walls[i], plan.walls[static_cast<size_t>(other)]);
    }
    out << "</g>\n<g id=\"openings\" stroke=\"#4a90d9\" stroke-width=\"0.04\" stroke-dasharray=\"0.15\">\n";
    for (const Opening& opening : plan.openings) writeLine(out, opening.start, opening.end);
    out << "</g>\n<g id=\"walls\" stroke=\"black\" stroke-width=\"0.08\" stroke-linecap=\"round\">\n";
    for (const PlanWall& wall : plan.walls) writeLine(out, wall.start, wall.end, covarianceAttribute(wall));
    out << "</g>\n</g>\n</svg>\n";
  });
}

void savePlanGeoJson(const files::OutputFolder& folder, const FloorPlan& plan) {
  Json features = Json::array();
  for (size_t i = 0; i < plan.walls.size(); ++i)
    features.push_back(feature(plan.walls[i].start, plan.walls[i].end, properties(plan.walls[i], i)));
  for (const Opening& opening : plan.openings)
    features.push_back(
        feature(opening.start, opening.end,
                {{"kind", "opening"}, {"width_m", rounded((opening.end - opening.start).norm())}}));
  const Json json{
      {"type", "FeatureCollection"},
      {"description",
       "floor plan; coordinates are metres in the map frame, not longitude and latitude; the free "
       "side of a wall is on the left of its direction; covariance: of the wall's offset to the "
       "left (m) and its angle (rad) at its middle, without the drift of the map"},
      {"directions_rad", plan.directions},
      {"features", features}};
  folder.write("plan.geojson", [&](std::ostream& out) {
    // A feature a line, so that plans can be compared with diff.
    out << "{\n";
    for (const auto& [key, value] : json.items())
      if (key != "features") out << Json(key) << ": " << value << ",\n";
    out << "\"features\": [";
    for (size_t i = 0; i < features.size(); ++i) out << (i ? ",\n" : "\n") << features[i];
    out << "\n]}\n";
  });
}

void savePlan(const files::OutputFolder& folder, const FloorPlan& plan) {
  savePlanSvg(folder, plan);
  savePlanDxf(folder, plan);
  savePlanGeoJson(folder, plan);
}

}  // namespace hybrid_slam::run
