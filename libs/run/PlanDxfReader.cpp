// Reads the walls of a DXF without dxflib, which allocates any number of vertices that a file claims to have.
#include <mrpt/core/bits_math.h>
#include <mrpt/system/string_utils.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/Numbers.h"
#include "run/PlanLines.h"

namespace hybrid_slam::run {
namespace {

using mrpt::math::TPoint2D;

constexpr double kChord = mrpt::DEG2RAD(10.0);
constexpr double kStraight = 1e-3;  // bulge: an arc that leaves its chord by 1/2000 of it
constexpr double kShortest = 1e-6;  // m

/// Returns the length (m) of the unit $INSUNITS (DXF reference, HEADER section).
double metresOf(double unit) {
  static const std::map<double, double> known{{0, 1},       {1, 0.0254},  {2, 0.3048},  {3, 1609.344},
                                              {4, 0.001},   {5, 0.01},    {6, 1},       {7, 1000},
                                              {8, 2.54e-8}, {9, 2.54e-5}, {10, 0.9144}, {13, 1e-6},
                                              {14, 0.1},    {15, 10},     {16, 100},    {21, 1200 / 3937.0}};
  const auto found = known.find(unit);
  if (found == known.end()) throw std::runtime_error("unknown unit, $INSUNITS " + numberText(unit));
  return found->second;
}

/// Reads the groups of a DXF: a code on one line, its value on the next (DXF reference, "Group codes").
class Groups {
 public:
  explicit Groups(const std::string& text) : in_(text) {}

  int code = 0;
  std::string value;

  /// Reads the next group; returns false at the end.
  bool next() {
    std::string text;
    if (!std::getline(in_, text)) return false;
    text = withoutBlanks(text);
    const bool hasValue = static_cast<bool>(std::getline(in_, value));
    if (!hasValue && text.empty()) return false;
    line_ += 2;
    const auto number = parseFinite(text);
    if (!hasValue || !number || std::abs(*number) > 10000) fail("expected a group code and its value");
    code = static_cast<int>(*number);
    value = withoutBlanks(value);
    return true;
  }
  double number() const {
    const auto number = parseFinite(value);
    if (!number) fail("expected a number");
    return *number;
  }

 private:
  static std::string withoutBlanks(const std::string& line) {
    return mrpt::system::trim(line.substr(0, line.find('\r')));
  }
  [[noreturn]] void fail(const std::string& expected) const {
    throw std::runtime_error("line " + std::to_string(line_ - 1) + " of the DXF: " + expected);
  }

  std::istringstream in_;
  size_t line_ = 0;
};

/// An entity of the section ENTITIES. Those of BLOCKS are drawn only where an INSERT places them.
struct Entity {
  std::string type, layer;
  std::vector<std::pair<int, double>> geometry;  ///< codes and numbers, in the order of the file

  /// Returns the first number with a code; 0 if there is none.
  double at(int code) const {
    for (const auto& [found, number] : geometry)
      if (found == code) return number;
    return 0;
  }
  bool isClosed() const { return std::fmod(at(70), 2) == 1; }
};

struct Vertex {
  TPoint2D at;
  double bulge = 0;  ///< of the arc to the next vertex: tan(turn / 4), positive counter-clockwise
};

class DxfWalls {
 public:
  explicit DxfWalls(PlanLines& lines) : lines_(lines) {}

  /// @param metre  length (m) of the drawing's unit
  void setUnit(double metre) { metre_ = metre; }
  void add(const Entity& entity) {
    if (entity.layer == "OPENINGS") return;
    // Flat entities are drawn in the plane of their extrusion, mirrored if it points down. That of a POLYLINE
    // holds for its vertices.
    if (entity.type != "VERTEX" && entity.type != "SEQEND")
      side_ = entity.type != "LINE" && entity.at(230) < 0 ? -1 : 1;
    if (entity.type == "LINE") addWall({entity.at(10), entity.at(20)}, {entity.at(11), entity.at(21)});
    if (entity.type == "CIRCLE") addArc({entity.at(10), entity.at(20)}, entity.at(40), 0, 2 * M_PI);
    if (entity.type == "ARC") addArcOf(entity);
    if (entity.type == "LWPOLYLINE") addPolyline(verticesOf(entity), entity.isClosed());
    // The vertices of a POLYLINE are entities up to a SEQEND.
    if (entity.type == "POLYLINE") vertices_.clear(), isClosed_ = entity.isClosed();
    if (entity.type == "VERTEX") vertices_.push_back({{entity.at(10), entity.at(20)}, entity.at(42)});
    if (entity.type == "SEQEND") addPolyline(std::exchange(vertices_, {}), isClosed_);
  }

 private:
  static std::vector<Vertex> verticesOf(const Entity& entity) {
    std::vector<Vertex> vertices;
    for (const auto& [code, number] : entity.geometry) {
      if (code == 10) vertices.push_back({{number, 0}});
      if (vertices.empty()) continue;
      if (code == 20) vertices.back().at.y = number;
      if (code == 42) vertices.back().bulge = number;
    }
    return vertices;
  }
  void addPolyline(const std::vector<Vertex>& vertices, bool isClosed) {
    for (size_t i = 0; i + 1 < vertices.size(); ++i) addBulged(vertices[i], vertices[i + 1].at);
    if (isClosed && vertices.size() > 1) addBulged(vertices.back(), vertices.front().at);
  }
  void addBulged(const Vertex& from, const TPoint2D& b) {
    const TPoint2D& a = from.at;
    const double bulge = from.bulge;
    if (!(std::abs(bulge) > kStraight)) return addWall(a, b);
    const TPoint2D left(a.y - b.y, b.x - a.x);
    const TPoint2D centre = (a + b) * 0.5 + left * ((1 - bulge * bulge) / (4 * bulge));
    addArc(centre, (a - centre).norm(), std::atan2(a.y - centre.y, a.x - centre.x), 4 * std::atan(bulge));
  }
  void addArcOf(const Entity& arc) {
    const double turn = std::fmod(arc.at(51) - arc.at(50), 360);  // deg, counter-clockwise
    addArc({arc.at(10), arc.at(20)}, arc.at(40), mrpt::DEG2RAD(arc.at(50)),
           mrpt::DEG2RAD(turn <= 0 ? turn + 360 : turn));
  }
  /// @param turn  rad, in [-2 pi, 2 pi]
  void addArc(const TPoint2D& centre, double radius, double from, double turn) {
    if (radius * metre_ <= kShortest) return;
    const int chords = std::max(1, static_cast<int>(std::ceil(std::abs(turn) / kChord - 1e-9)));
    const auto at = [&](int i) {
      const double angle = from + turn * i / chords;
      return centre + TPoint2D(std::cos(angle), std::sin(angle)) * radius;
    };
    for (int i = 0; i < chords; ++i) addWall(at(i), at(i + 1));
  }
  void addWall(const TPoint2D& a, const TPoint2D& b) { lines_.add(inMetres(a), inMetres(b)); }
  TPoint2D inMetres(const TPoint2D& p) const { return {side_ * p.x * metre_, p.y * metre_}; }

  PlanLines& lines_;
  double metre_ = 1;
  double side_ = 1;               ///< -1: seen from below
  std::vector<Vertex> vertices_;  ///< of the POLYLINE being read
  bool isClosed_ = false;
};

bool isGeometry(int code) {
  static const std::set<int> codes{10, 11, 20, 21, 40, 42, 50, 51, 70, 230};
  return codes.count(code) > 0;
}

}  // namespace

void readPlanDxf(const std::string& text, PlanLines& lines) {
  static const std::set<std::string> drawn{"LINE",     "CIRCLE", "ARC",   "LWPOLYLINE",
                                           "POLYLINE", "VERTEX", "SEQEND"};
  Groups group(text);
  std::string section, variable;
  DxfWalls walls(lines);
  Entity entity;
  while (group.next()) {
    const bool isDrawn = section == "ENTITIES" && drawn.count(entity.type) > 0;
    if (group.code == 0) {
      if (isDrawn) walls.add(entity);
      entity = {group.value, "", {}};
      if (group.value == "ENDSEC") section.clear();
      if (group.value == "EOF") return;
    } else if (group.code == 2 && entity.type == "SECTION") {
      section = group.value;
    } else if (group.code == 9) {
      variable = group.value;
    } else if (section == "HEADER" && variable == "$INSUNITS" && group.code == 70) {
      walls.setUnit(metresOf(group.number()));
    } else if (isDrawn && group.code == 8) {
      entity.layer = group.value;
    } else if (isDrawn && isGeometry(group.code)) {
      entity.geometry.emplace_back(group.code, group.number());
    }
  }
}

}  // namespace hybrid_slam::run
