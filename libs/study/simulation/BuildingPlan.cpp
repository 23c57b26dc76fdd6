#include "study/simulation/BuildingPlan.h"

#include <cmath>

#include "study/simulation/FloorPlanFile.h"

namespace hybrid_slam::simulation {

BuildingPlan BuildingPlan::load(const std::string& file) { return BuildingPlan(readWalls(file)); }

BuildingPlan BuildingPlan::with(const std::vector<Wall>& more) const {
  std::vector<Wall> all = walls();
  all.insert(all.end(), more.begin(), more.end());
  return BuildingPlan(std::move(all));
}

std::optional<double> BuildingPlan::castRay(const mrpt::math::TPoint2D& origin, double heading,
                                            double maxRange) const {
  const double range = index_.rayDistance(origin, {std::cos(heading), std::sin(heading)}, maxRange);
  return std::isfinite(range) ? std::optional<double>(range) : std::nullopt;
}

}  // namespace hybrid_slam::simulation
