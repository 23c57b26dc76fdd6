#include "window/view/FilterSnapshot.h"
#include "slam/lines/WallDirections.h"

#include <algorithm>
#include <cmath>

namespace hybrid_slam::window {
UncertaintyEllipse uncertaintyOf(const std::vector<WeightedPose>& poses) {
  UncertaintyEllipse ellipse;
  if (poses.empty()) return ellipse;
  double top = poses.front().logWeight, sum = 0;
  for (const auto& p : poses) top = std::max(top, p.logWeight);
  for (const auto& p : poses) {
    const double w = std::exp(p.logWeight - top);
    sum += w;
    ellipse.centre.x += w * p.pose.x;
    ellipse.centre.y += w * p.pose.y;
  }
  ellipse.centre.x /= sum;
  ellipse.centre.y /= sum;
  double xx = 0, xy = 0, yy = 0;
  for (const auto& p : poses) {
    const double w = std::exp(p.logWeight - top) / sum;
    const double dx = p.pose.x - ellipse.centre.x, dy = p.pose.y - ellipse.centre.y;
    xx += w * dx * dx;
    xy += w * dx * dy;
    yy += w * dy * dy;
  }
  const double mean = (xx + yy) / 2, swing = std::hypot((xx - yy) / 2, xy);
  ellipse.major = std::sqrt(std::max(mean + swing, 0.0));
  ellipse.minor = std::sqrt(std::max(mean - swing, 0.0));
  ellipse.direction = std::atan2(2 * xy, xx - yy) / 2;
  return ellipse;
}

FilterWatch::FilterWatch(const run::Configuration& configuration, bool judges)
    : method_(nameOf(configuration.run.method)),
      useLines_(configuration.filter.useLines),
      judges_(judges),
      lineWeight_(configuration.filter.lineWeight),
      prepare_(configuration.filter),
      mapSoFar_(configuration.filter.grid.maxRange) {}

void FilterWatch::saw(const FilterView& view, const readings::Reading& reading, bool isUpdate) {
  if (!start_) start_ = reading.timestamp;
  if (isUpdate && judges_ && !view.place()) mapSoFar_.add(view, reading.scans);
  const auto place = view.place();
  if (!place) knownFrom_ = 0;
  if (place && !place->isKnown) {
    knownFrom_ = view.updates();
    scans_.clear();
    if (useLines_) linesAfter_ = view.bestLines();
    return;
  }
  if (!isUpdate) return;
  const FilterStep& step = view.lastStep();
  plot_.push_back({reading.timestamp - *start_, step.stdX, step.stdY, step.stdPhi, step.ess});
  if (!useLines_) return;
  scans_ = reading.scans;
  linesBefore_ = std::exchange(linesAfter_, view.bestLines());
}

std::shared_ptr<FilterSnapshot> FilterWatch::snapshot(const FilterView& view, bool withVerdict) const {
  auto out = std::make_shared<FilterSnapshot>();
  out->method = method_;
  out->updates = view.updates();
  out->map = mapImage(view.bestGrid());
  out->path = view.bestPath();
  out->path.erase(out->path.begin(),
                  out->path.begin() + static_cast<std::ptrdiff_t>(std::min(knownFrom_, out->path.size())));
  out->lines = linesAfter_;
  out->dominatingDirection = directionModuloRightAngle(out->lines);
  out->particles = view.particlePoses();
  out->place = view.place();
  out->ellipse = uncertaintyOf(out->particles);
  out->plot = plot_;
  if (view.updates() > 0) out->step = view.lastStep();
  if (withVerdict && judges_ && out->updates > 0 && !out->place) out->verdict = mapSoFar_.judge(view)();
  if (scans_.empty() || out->path.empty()) return out;
  const LineDatabase before(linesBefore_);
  const mrpt::math::TPose2D& pose = out->path.back();
  const auto compared = comparedLines(before, {pose.x, pose.y}, lineWeight_);
  for (const LineSegment& line : prepare_(scans_).lines) {
    const LineSegment placed = transformed(line, pose);
    out->scanLines.push_back({placed, matchDirection(placed.theta, *compared, lineWeight_).isMatched});
  }
  return out;
}

}  // namespace hybrid_slam::window
