/// @file LineWeight.h
/// @brief w_line: how well the lines seen now agree in direction with a particle's line database (Sec.
/// III-D).
#pragma once

#include <vector>

#include "base/Options.h"
#include "lines/LineDatabase.h"
#include "lines/LineSegment.h"

namespace hybrid_slam {

/// Section [line_weight].
struct LineWeightOptions : Options {
  enum class Method {
    dominatingDirection,  ///< graded, against the direction that the database's lines have in common
    paper                 ///< eq. (9): any database line parallel or perpendicular within a threshold
  };
  Method method = Method::dominatingDirection;
  double sigma = 0.5 * M_PI / 180;    ///< rad
  double threshold = 3 * M_PI / 180;  ///< rad
  double floor = 0.001;

  void describe(OptionTable& table) override;
};

struct LineWeight {
  double value = 1;  ///< in [floor, 1]; 1 where no line was seen or the database has no direction yet
  int seen = 0;      ///< lines seen
  int matched = 0;   ///< of these, parallel or perpendicular within 2 sigma (graded) or the threshold (paper)
};

/// w_line of a particle, after eq. (9): total length of matched lines / total length of detected lines.
///
/// `paper` counts a line as matched where any database line is parallel or perpendicular to it within
/// `threshold`. `dominatingDirection` lets each line count by exp(-d^2 / (2 sigma^2)), d its angle from the
/// dominating direction modulo a right angle, as the paper's introduction asks; why: doc/paper-notes.md.
/// Neither falls below `floor`, so that one bad scan cannot end a particle. Does not allocate.
///
/// @param seen     lines in the robot frame: only their directions matter, so one list serves all particles
/// @param heading  the particle's heading in the map, rad
LineWeight lineWeight(const std::vector<LineSegment>& seen, double heading, const LineDatabase& database,
                      const LineWeightOptions& options);

}  // namespace hybrid_slam
