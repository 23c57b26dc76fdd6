#include <mrpt/core/bits_math.h>

#include <cmath>
#include <optional>

#include "base/Errors.h"
#include "study/simulation/RecordFile.h"
#include "study/simulation/Route.h"

namespace hybrid_slam::simulation {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace {

double wrapped(double angle) { return std::remainder(angle, 2 * M_PI); }

/// Builds the pieces of the route record by record.
class RouteBuilder {
 public:
  void add(const Record& record);
  std::vector<Route::Piece> finish(const std::string& file);

 private:
  struct Corner {
    TPoint2D point;
    double radius = 0;
    Record record;
  };

  void drive(double v, double omega, double duration, const Record& record);
  void turnTo(double heading, const Record& record);
  void straightTo(const TPoint2D& target, const Record& record);
  void roundCorner(const TPoint2D& next);
  double distanceTo(const TPoint2D& p) const { return std::hypot(p.x - pose_.x, p.y - pose_.y); }
  double headingTo(const TPoint2D& p) const { return std::atan2(p.y - pose_.y, p.x - pose_.x); }

  bool started_ = false;
  TPose2D pose_;
  double time_ = 0;
  double speed_ = 0.5;                      // m/s
  double turnSpeed_ = mrpt::DEG2RAD(45.0);  // rad/s
  std::optional<Corner> corner_;            // rounded once the next point is known
  std::vector<Route::Piece> pieces_;
};

void RouteBuilder::drive(double v, double omega, double duration, const Record& record) {
  if (duration <= 0) return;
  pieces_.push_back({time_, duration, pose_, v, omega, record.where});
  pose_ = pieces_.back().poseAfter(duration);
  time_ += duration;
}

void RouteBuilder::turnTo(double heading, const Record& record) {
  const double turn = wrapped(heading - pose_.phi);
  if (std::abs(turn) < 1e-9) return;
  drive(0, std::copysign(turnSpeed_, turn), std::abs(turn) / turnSpeed_, record);
  pose_.phi = heading;
}

void RouteBuilder::straightTo(const TPoint2D& target, const Record& record) {
  if (distanceTo(target) < 1e-3)
    throw InputError("repeated way point", record.where, "expected a way point at least 1 mm away");
  turnTo(headingTo(target), record);
  drive(speed_, 0, distanceTo(target) / speed_, record);
  pose_.x = target.x;
  pose_.y = target.y;
}

/// Drives to the corner's tangent point, then along the arc towards `next`.
void RouteBuilder::roundCorner(const TPoint2D& next) {
  const Corner corner = *corner_;
  corner_.reset();
  const double before = distanceTo(corner.point);
  const double after = std::hypot(next.x - corner.point.x, next.y - corner.point.y);
  if (before < 1e-3 || after < 1e-3)
    throw InputError("repeated way point", corner.record.where, "expected way points at least 1 mm apart");
  const double heading = headingTo(corner.point);
  const double nextHeading = std::atan2(next.y - corner.point.y, next.x - corner.point.x);
  const double turn = wrapped(nextHeading - heading);
  const double tangent = corner.radius * std::tan(std::abs(turn) / 2);
  if (tangent > before + 1e-9 || tangent > after + 1e-9)
    throw InputError("curve does not fit between its neighbours", corner.record.where,
                     "expected a smaller RADIUS or way points farther apart");
  if (before - tangent > 1e-6)
    straightTo(corner.point - TPoint2D(std::cos(heading), std::sin(heading)) * tangent, corner.record);
  const double v = std::min(speed_, turnSpeed_ * corner.radius);
  drive(v, std::copysign(v / corner.radius, turn), std::abs(turn) * corner.radius / v, corner.record);
  pose_.phi = nextHeading;
}

void RouteBuilder::add(const Record& record) {
  const std::vector<double>& v = record.numbers;
  const auto expectPositive = [&record](double value, const std::string& unit) {
    if (!(value >= 1e-3))
      throw InputError("`" + record.word + "` too low", record.where, "expected at least 0.001 " + unit);
  };
  if (record.word == "start") {
    expectNumbers(record, "X Y HEADING_DEG");
    if (started_)
      throw InputError("second `start`", record.where, "expected one `start`, before all way points");
    started_ = true;
    pose_ = {v[0], v[1], mrpt::DEG2RAD(v[2])};
    return;
  }
  if (record.word == "speed") {
    expectNumbers(record, "M_PER_S");
    expectPositive(v[0], "m/s");
    speed_ = v[0];
    return;
  }
  if (record.word == "turn_speed") {
    expectNumbers(record, "DEG_PER_S");
    expectPositive(v[0], "deg/s");
    turnSpeed_ = mrpt::DEG2RAD(v[0]);
    return;
  }
  if (!started_)
    throw InputError("`" + record.word + "` before `start`", record.where,
                     "expected `start X Y HEADING_DEG` first");
  if (record.word == "via" || record.word == "go") {
    expectNumbers(record, record.word == "via" ? "X Y RADIUS" : "X Y");
    const TPoint2D target(v[0], v[1]);
    if (corner_) roundCorner(target);
    if (record.word == "go") {
      straightTo(target, record);
    } else {
      expectPositive(v[2], "m");
      corner_ = Corner{target, v[2], record};
    }
    return;
  }
  if (corner_)
    throw InputError("`via` followed by `" + record.word + "`", corner_->record.where,
                     "expected `go` or `via` after it");
  if (record.word == "turn") {
    expectNumbers(record, "HEADING_DEG");
    turnTo(mrpt::DEG2RAD(v[0]), record);
  } else {
    expectNumbers(record, "SECONDS");
    expectPositive(v[0], "s");
    drive(0, 0, v[0], record);
  }
}

std::vector<Route::Piece> RouteBuilder::finish(const std::string& file) {
  if (corner_)
    throw InputError("route ends with `via`", corner_->record.where, "expected `go` or `via` after it");
  if (pieces_.empty())
    throw InputError("route without way points", "file " + file,
                     "expected `start X Y HEADING_DEG` and `go X Y`");
  return std::move(pieces_);
}

}  // namespace

Route Route::load(const std::string& file) {
  RouteBuilder builder;
  for (const Record& record :
       readRecords(file, {"start", "speed", "turn_speed", "go", "via", "turn", "wait"}))
    builder.add(record);
  return Route(builder.finish(file));
}

}  // namespace hybrid_slam::simulation
