/// @file LineWeight.h
/// @brief w_line: agreement in direction of the observed lines with a particle's line database (Sec. III-D).
#pragma once

#include <mrpt/core/bits_math.h>
#include <mrpt/math/TPoint2D.h>

#include <memory>
#include <vector>

#include "base/Options.h"
#include "slam/lines/LineDatabase.h"
#include "slam/lines/LineSegment.h"

namespace hybrid_slam {

/// Section [line_weight].
struct LineWeightOptions : Options {
  enum class Method {
    frames,               ///< smooth match to the directions that several lines share (DirectionFrames.h)
    graded,               ///< eq. (9) with a smooth match to all directions of the database
    dominatingDirection,  ///< smooth match to the dominating direction of the database
    paper                 ///< eq. (9): any database line parallel or perpendicular within a threshold
  };
  Method method = Method::graded;
  double sigma = mrpt::DEG2RAD(0.4);       ///< rad
  double threshold = mrpt::DEG2RAD(0.25);  ///< rad
  double floor = 0.001;
  double radius = 0;  ///< m; 0: unlimited

  void describe(OptionTable& table) override;
};

/// The lines of a database within `radius` (m) of the robot; all if it is 0.
LineDatabase linesNear(const LineDatabase& database, const mrpt::math::TPoint2D& robot, double radius);

/// What the lines seen by a robot at `robot` (map frame) are compared with: the lines of the database within
/// options.radius or, for `frames`, one line for each direction that several of them share. Without any, the
/// weight is neutral. Not a copy, but the database itself, where all its lines count; it must then outlive
/// the result.
std::shared_ptr<const LineDatabase> comparedLines(const LineDatabase& database,
                                                  const mrpt::math::TPoint2D& robot,
                                                  const LineWeightOptions& options);

/// Agreement of one direction with a database.
struct DirectionMatch {
  double value = 0;  ///< in [0, 1]
  double slope = 0;  ///< derivative with respect to the direction, 1/rad; 0 for eq. (9), which is a step
  bool isMatched = false;  ///< parallel or perpendicular within 2 sigma, or the threshold of eq. (9)
};

/// Let d_j be the angle between theta (rad, map frame) and the direction of database line j, modulo 90 deg,
/// and w_j the evidence of that line:
///
/// - `graded`: sum_j w_j exp(-d_j^2 / (2 sigma^2)) / sum_j w_j. Lines newly inserted by a drifting particle
///   have little evidence; several building directions can coexist.
/// - `frames`: the same; the database is then one of direction frames (comparedLines).
/// - `dominatingDirection`: exp(-d^2 / (2 sigma^2)), d the angle to LineDatabase::dominatingDirection().
/// - `paper`, eq. (9): 1 if some d_j, to the line's theta, is below `threshold`, else 0.
///
/// There is no match (value 0) if the database is empty or, for `dominatingDirection`, has no dominating
/// direction.
DirectionMatch matchDirection(double theta, const LineDatabase& database, const LineWeightOptions& options);

/// w_line at one heading.
struct LineWeight {
  double value = 1;  ///< in [floor, 1]; 1 if no line was observed or the database has no direction yet
  double slope = 0;  ///< derivative of value with respect to the heading, 1/rad; 0 at the floor
  int seen = 0;      ///< observed lines
  int matched = 0;   ///< those parallel or perpendicular to lines of the database

  template <class State>
  void visit(State& state) {
    state(value, slope, seen, matched);
  }
};

/// w_line of a particle, eq. (9): total length of matched lines / total length of detected lines, each
/// matched line weighted by its DirectionMatch. At least `floor`, so that one bad scan cannot kill a
/// particle. Does not allocate.
///
/// @param seen     lines in the robot frame; only directions matter, so one list serves all particles
/// @param heading  the particle's heading in the map, rad
LineWeight lineWeight(const std::vector<LineSegment>& seen, double heading, const LineDatabase& database,
                      const LineWeightOptions& options);

}  // namespace hybrid_slam
