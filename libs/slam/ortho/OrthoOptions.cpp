#include "slam/ortho/OrthoOptions.h"

namespace hybrid_slam {

void OrthoOptions::describe(OptionTable& t) {
  t.addAngle("max_angle_deg", maxAngle, 0.1, 45,
             "largest angle between a line and the building's directions, by the predicted heading; other "
             "lines are left out");
  t.addAngle("sigma_angle_deg", sigmaAngle, 0.01, 22.5,
             "standard deviation of a scan's heading from its lines; walls are not exactly at right angles");
  t.add("sigma_offset", sigmaOffset, 0.001, 10, "m", "standard deviation of a line's distance");
  t.add("gate", gate, 0.1, 100, "", "largest difference of one wall's lines, in standard deviations");
  t.add("max_gap", maxGap, 0, 100, "m", "largest gap between two pieces of one wall");
  t.add("min_length", minLength, 0, 100, "m", "minimum length of a new line");
}

}  // namespace hybrid_slam
