#include "study/simulation/FloorPlanFile.h"

#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/Errors.h"
#include "study/simulation/RecordFile.h"

namespace hybrid_slam::simulation {

using mrpt::math::TPoint2D;

namespace {

/// Points of a record whose numbers come in pairs.
std::vector<TPoint2D> pointsOf(const Record& record, size_t atLeast) {
  const size_t n = record.numbers.size();
  if (n % 2 != 0 || n < 2 * atLeast)
    throw InputError("`" + record.word + "` with " + std::to_string(n) + " numbers", record.where,
                     "expected `" + record.word + " X1 Y1 X2 Y2 ...` with at least " +
                         std::to_string(atLeast) + " points");
  std::vector<TPoint2D> points;
  for (size_t i = 0; i < n; i += 2) points.emplace_back(record.numbers[i], record.numbers[i + 1]);
  return points;
}

/// Builds the walls record by record; doors and recesses are applied after all walls are known.
class WallBuilder {
 public:
  void add(const Record& record);
  std::vector<Wall> finish();

 private:
  void addChain(const std::vector<TPoint2D>& points, const Record& record);
  void addArc(double x, double y, double radius, double startDeg, double sweepDeg, const Record& record);
  void cut(const TPoint2D& from, const TPoint2D& to, const Record& record);

  std::vector<Wall> walls_;
  std::vector<Record> openings_;
};

void WallBuilder::addChain(const std::vector<TPoint2D>& points, const Record& record) {
  for (size_t i = 1; i < points.size(); ++i) {
    if ((points[i] - points[i - 1]).norm() < kTolerance)
      throw InputError("wall of zero length", record.where,
                       "expected the ends of each wall at least 1 mm apart (point " + std::to_string(i + 1) +
                           " repeats the previous one)");
    walls_.push_back(Wall::straight(points[i - 1], points[i]));
  }
}

void WallBuilder::addArc(double x, double y, double radius, double startDeg, double sweepDeg,
                         const Record& record) {
  if (radius < kTolerance || sweepDeg <= 0 || sweepDeg > 360 || radius * mrpt::DEG2RAD(sweepDeg) < kTolerance)
    throw InputError("wall of zero length", record.where,
                     "expected a radius above 0 m and an end up to 360 deg counter-clockwise of the start");
  walls_.push_back(Wall::arc({x, y}, radius, mrpt::DEG2RAD(startDeg), mrpt::DEG2RAD(sweepDeg)));
}

void WallBuilder::add(const Record& record) {
  const std::vector<double>& v = record.numbers;
  if (record.word == "wall") {
    expectNumbers(record, "X1 Y1 X2 Y2");
    addChain(pointsOf(record, 2), record);
  } else if (record.word == "polyline") {
    addChain(pointsOf(record, 2), record);
  } else if (record.word == "polygon") {
    const auto points = pointsOf(record, 4);
    if ((points.front() - points.back()).norm() >= kTolerance)
      throw InputError("polygon is not closed", record.where, "expected the last point to repeat the first");
    addChain(points, record);
  } else if (record.word == "rectangle") {
    expectNumbers(record, "X1 Y1 X2 Y2");
    addChain({{v[0], v[1]}, {v[2], v[1]}, {v[2], v[3]}, {v[0], v[3]}, {v[0], v[1]}}, record);
  } else if (record.word == "arc") {
    expectNumbers(record, "CX CY RADIUS START_DEG END_DEG");
    // 350 to 10 deg is an arc of 20 deg.
    addArc(v[0], v[1], v[2], v[3], v[4] < v[3] ? v[4] - v[3] + 360 : v[4] - v[3], record);
  } else if (record.word == "circle") {
    expectNumbers(record, "CX CY RADIUS");
    addArc(v[0], v[1], v[2], 0, 360, record);
  } else {
    if (record.word == "door" && v.size() == 4) {
      pointsOf(record, 2);
    } else {
      expectNumbers(record, "X1 Y1 X2 Y2 DEPTH");
    }
    openings_.push_back(record);
  }
}

/// Removes the section from..to from the straight walls along it.
void WallBuilder::cut(const TPoint2D& from, const TPoint2D& to, const Record& record) {
  std::vector<std::pair<double, double>> covered;  // m from `from`
  std::vector<Wall> kept;
  for (const Wall& wall : walls_) {
    const TPoint2D along = (wall.end - wall.start) * (wall.isArc() ? 0 : 1 / wall.length());
    const TPoint2D a = from - wall.start, b = to - wall.start;
    const double s = a.x * along.x + a.y * along.y, t = b.x * along.x + b.y * along.y;
    const double low = std::max(0.0, std::min(s, t)), high = std::min(wall.length(), std::max(s, t));
    const bool onLine = (a - along * s).norm() < kTolerance && (b - along * t).norm() < kTolerance;
    if (wall.isArc() || !onLine || high - low < kTolerance) {
      kept.push_back(wall);
      continue;
    }
    covered.emplace_back(std::minmax(std::abs(low - s), std::abs(high - s)));
    if (low > kTolerance) kept.push_back(Wall::straight(wall.start, wall.start + along * low));
    if (high < wall.length() - kTolerance)
      kept.push_back(Wall::straight(wall.start + along * high, wall.end));
  }
  std::sort(covered.begin(), covered.end());
  double reach = 0;
  for (const auto& [begin, end] : covered)
    if (begin < reach + kTolerance) reach = std::max(reach, end);
  const double width = (to - from).norm();
  if (width < kTolerance || reach < width - kTolerance)
    throw InputError("`" + record.word + "` is on no wall", record.where,
                     "expected both ends on the same straight wall, at least 1 mm apart");
  walls_ = std::move(kept);
}

std::vector<Wall> WallBuilder::finish() {
  for (const Record& opening : openings_) {
    const TPoint2D from(opening.numbers[0], opening.numbers[1]), to(opening.numbers[2], opening.numbers[3]);
    cut(from, to, opening);
    if (opening.numbers.size() == 4) continue;
    const double depth = opening.numbers[4], width = (to - from).norm();
    if (std::abs(depth) < kTolerance)
      throw InputError("wall of zero length", opening.where, "expected a DEPTH of at least 1 mm");
    const TPoint2D inwards((from.y - to.y) / width * depth, (to.x - from.x) / width * depth);
    if (opening.word == "door") {
      cut(from + inwards, to + inwards, opening);
      walls_.push_back(Wall::straight(from, from + inwards));
      walls_.push_back(Wall::straight(to, to + inwards));
    } else {
      addChain({from, from + inwards, to + inwards, to}, opening);
    }
  }
  return std::move(walls_);
}

}  // namespace

std::vector<Wall> readWalls(const std::string& file) {
  WallBuilder builder;
  for (const Record& record :
       readRecords(file, {"wall", "polyline", "polygon", "rectangle", "arc", "circle", "door", "recess"}))
    builder.add(record);
  std::vector<Wall> walls = builder.finish();
  if (walls.empty())
    throw InputError("floor plan without walls", "file " + file, "expected a line like `wall 0 0 4 0`");
  return walls;
}

}  // namespace hybrid_slam::simulation
