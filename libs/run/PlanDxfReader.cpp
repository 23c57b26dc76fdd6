// Reads the walls of a DXF.
#include <dxflib/dl_creationadapter.h>
#include <dxflib/dl_dxf.h>

#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>

#include "run/PlanLines.h"

namespace hybrid_slam::run {
namespace {

using mrpt::math::TPoint2D;

constexpr size_t kLongestLine = 1000;  // bytes; dxflib cuts longer ones
constexpr double kChord = M_PI / 18;   // rad
constexpr double kStraight = 1e-3;     // bulge: an arc that leaves its chord by 1/2000 of it

/// m of the unit $INSUNITS (DXF reference, HEADER section).
double metresOf(int unit) {
  static const std::map<int, double> known{{0, 1},       {1, 0.0254},  {2, 0.3048},  {3, 1609.344},
                                           {4, 0.001},   {5, 0.01},    {6, 1},       {7, 1000},
                                           {8, 2.54e-8}, {9, 2.54e-5}, {10, 0.9144}, {13, 1e-6},
                                           {14, 0.1},    {15, 10},     {16, 100},    {21, 1200 / 3937.0}};
  const auto found = known.find(unit);
  if (found == known.end()) throw std::runtime_error("unknown unit, $INSUNITS " + std::to_string(unit));
  return found->second;
}

class DxfWalls : public DL_CreationAdapter {
 public:
  explicit DxfWalls(PlanLines& lines) : lines_(lines) {}

  void setVariableInt(const std::string& key, int value, int) override {
    if (key == "$INSUNITS") metre_ = metresOf(value);
  }
  // A block is drawn where an INSERT places it, not where it is defined.
  void addBlock(const DL_BlockData&) override { isBlock_ = true; }
  void endBlock() override { isBlock_ = false; }

  void addLine(const DL_LineData& line) override { addWall({line.x1, line.y1}, {line.x2, line.y2}); }
  void addArc(const DL_ArcData& arc) override {
    const double from = arc.angle1 * M_PI / 180, turn = (arc.angle2 - arc.angle1) * M_PI / 180;
    addArc({arc.cx, arc.cy}, arc.radius, from, turn - 2 * M_PI * std::floor(turn / (2 * M_PI)));
  }
  void addCircle(const DL_CircleData& circle) override {
    addArc({circle.cx, circle.cy}, circle.radius, 0, 2 * M_PI);
  }

  void addPolyline(const DL_PolylineData& polyline) override {
    isClosed_ = (polyline.flags & 1) != 0;
    first_.reset();
  }
  void addVertex(const DL_VertexData& vertex) override {
    const TPoint2D p(vertex.x, vertex.y);
    if (first_)
      addBulged(last_, p, bulge_);
    else
      first_ = p;
    last_ = p, bulge_ = vertex.bulge;
  }
  void endEntity() override { close(); }
  void endSequence() override { close(); }

 private:
  void close() {
    if (first_ && isClosed_) addBulged(last_, *first_, bulge_);
    first_.reset();
  }
  /// An arc from a to b. @param bulge  tan(turn / 4), positive counter-clockwise
  void addBulged(const TPoint2D& a, const TPoint2D& b, double bulge) {
    if (!(std::abs(bulge) > kStraight)) return addWall(a, b);
    const TPoint2D left(a.y - b.y, b.x - a.x);
    const TPoint2D centre = (a + b) * 0.5 + left * ((1 - bulge * bulge) / (4 * bulge));
    addArc(centre, (a - centre).norm(), std::atan2(a.y - centre.y, a.x - centre.x), 4 * std::atan(bulge));
  }
  void addArc(const TPoint2D& centre, double radius, double from, double turn) {
    if (!std::isfinite(turn)) throw std::runtime_error("an arc without an angle");
    const int chords = std::max(1, static_cast<int>(std::ceil(std::abs(turn) / kChord - 1e-9)));
    const auto at = [&](int i) {
      const double angle = from + turn * i / chords;
      return centre + TPoint2D(std::cos(angle), std::sin(angle)) * radius;
    };
    for (int i = 0; i < chords; ++i) addWall(at(i), at(i + 1));
  }
  void addWall(const TPoint2D& a, const TPoint2D& b) {
    if (!isBlock_ && attributes.getLayer() != "OPENINGS") lines_.add(a * metre_, b * metre_);
  }

  PlanLines& lines_;
  double metre_ = 1;
  bool isBlock_ = false, isClosed_ = false;
  std::optional<TPoint2D> first_;
  TPoint2D last_;
  double bulge_ = 0;  ///< of the arc from last_ to the next vertex
};

}  // namespace

void readPlanDxf(const std::string& text, PlanLines& lines) {
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    if (line.size() > kLongestLine) throw std::runtime_error("a line of over 1000 characters");
  in.clear();
  in.seekg(0);
  DxfWalls walls(lines);
  DL_Dxf dxf;
  if (!dxf.in(in, &walls)) throw std::runtime_error("not readable");
}

}  // namespace hybrid_slam::run
