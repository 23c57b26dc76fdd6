#include "slam/features/FeatureOptions.h"

namespace hybrid_slam {

void FeatureOptions::describe(OptionTable& table) {
  table.add("enabled", enabled,
            "weigh particles by how the scan's corners, wall ends and arcs agree with their map");
  table.add("wall_ends", wallEnds, "use ends of walls at openings as features, too");
  table.add("min_wall", minWall, 0.05, 100, "m", "shortest visible wall at a corner or wall end");
  table.add("max_radius", maxRadius, 0, 100, "m",
            "largest radius of an arc (pillar, round hall); 0: no arcs");
  table.add("sigma", sigma, 0.001, 10, "m",
            "standard deviation of a feature's position in addition to that of its fit");
  table.add("floor", floor, 1e-6, 1, "", "weight of a feature that the map does not confirm");
  table.add("min_count", minCount, 1, 1000,
            "minimum number of observations of a feature; others are not used, and pruned");
  table.add("prune_interval", pruneInterval, 1, 10000,
            "updates between prunings, and grace period of a new feature");
}

}  // namespace hybrid_slam
