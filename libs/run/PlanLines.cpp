#include "run/PlanLines.h"

#include <cmath>

#include "base/Errors.h"
#include "run/PlanFiles.h"

namespace hybrid_slam::run {

void PlanLines::add(const mrpt::math::TPoint2D& start, const mrpt::math::TPoint2D& end) {
  constexpr double kFarthest = 1e6;  // m
  constexpr size_t kMost = 1'000'000;
  for (const double value : {start.x, start.y, end.x, end.y})
    if (!(std::abs(value) <= kFarthest))
      throw InputError("impossible coordinate in a floor plan", file_, "expected metres, at most 1e6");
  const double length = (end - start).norm();
  if (length <= 1e-6) return;
  checkPlanLength(length_ += length, file_);
  if (all_.size() == kMost) throw InputError("floor plan of over a million walls", file_, "expected fewer");
  all_.push_back({start, end});
}

void checkPlanLength(double length, const std::string& file) {
  constexpr double kMost = 3e4;  // m
  if (!(length <= kMost)) throw InputError("walls of over 30 km", file, "expected a floor plan in metres");
}

}  // namespace hybrid_slam::run
