#include "slam/loops/LoopClosingOptions.h"

namespace hybrid_slam {

void LoopClosingOptions::describe(OptionTable& t) {
  t.add("enabled", enabled, "close loops that the particles cannot, by a pose graph");
  t.add("min_distance", minDistance, 5, 10000, "m", "path between two visits that count as a loop");
  t.add("stretch", stretch, 1, 100, "m", "newest part of the path, matched as one scan");
  t.add("max_offset", maxOffset, 0.5, 50, "m", "largest position error that is searched");
  t.add("min_fit", minFit, 0.3, 1, "", "minimum share of the compared walls of both visits that agree");
  t.add("max_second", maxSecond, 0, 1, "",
        "maximum score of the second-best place, as a fraction of the best: ambiguous places do not close");
  t.add("agreeing", agreeing, 1, 20, "number of successive matches that must agree on the correction");
}

}  // namespace hybrid_slam
