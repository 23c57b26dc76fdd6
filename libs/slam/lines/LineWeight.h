/// @file LineWeight.h
/// @brief w_line: how well the lines seen now agree in direction with a particle's line database (Sec.
/// III-D).
#pragma once

#include <vector>

#include "base/Options.h"
#include "slam/lines/LineDatabase.h"
#include "slam/lines/LineSegment.h"

namespace hybrid_slam {

/// Section [line_weight].
struct LineWeightOptions : Options {
  enum class Method {
    graded,               ///< eq. (9) with a graded match, against all directions of the database
    dominatingDirection,  ///< graded, against the one direction that all lines of the database have in common
    paper                 ///< eq. (9): any database line parallel or perpendicular within a threshold
  };
  Method method = Method::graded;
  double sigma = 0.4 * M_PI / 180;       ///< rad
  double threshold = 0.25 * M_PI / 180;  ///< rad
  double floor = 0.001;

  void describe(OptionTable& table) override;
};

/// How well one direction agrees with a database.
struct DirectionMatch {
  double value = 0;        ///< in [0, 1]
  double slope = 0;        ///< derivative of value by the direction, 1/rad; 0 for eq. (9), which is a step
  bool isMatched = false;  ///< parallel or perpendicular within 2 sigma, or the threshold of eq. (9)
};

/// With d_j the angle between theta (rad, map frame) and the direction of database line j, modulo a right
/// angle, and w_j that line's evidence:
///
/// - `graded`: sum_j w_j exp(-d_j^2 / (2 sigma^2)) / sum_j w_j. Lines that a drifting particle has just
/// inserted have
///   little evidence, and several frames can stand side by side.
/// - `dominatingDirection`: exp(-d^2 / (2 sigma^2)), d the angle to LineDatabase::dominatingDirection().
/// - `paper`, eq. (9): 1 where some d_j, to the line's own theta, is below `threshold`, else 0.
///
/// No match (value 0) with a database that is empty or, for `dominatingDirection`, has no such direction.
DirectionMatch matchDirection(double theta, const LineDatabase& database, const LineWeightOptions& options);

struct LineWeight {
  double value = 1;  ///< in [floor, 1]; 1 where no line was seen or the database has no direction yet
  double slope = 0;  ///< derivative of value by the heading, 1/rad; 0 at the floor
  int seen = 0;      ///< lines seen
  int matched = 0;   ///< of these, parallel or perpendicular to lines of the database
};

/// w_line of a particle, eq. (9): total length of matched lines / total length of detected lines, where each
/// line counts with its length times its DirectionMatch. Not below `floor`, so that one bad scan cannot end a
/// particle. Does not allocate.
///
/// @param seen     lines in the robot frame: only their directions matter, so one list serves all particles
/// @param heading  the particle's heading in the map, rad
LineWeight lineWeight(const std::vector<LineSegment>& seen, double heading, const LineDatabase& database,
                      const LineWeightOptions& options);

}  // namespace hybrid_slam
