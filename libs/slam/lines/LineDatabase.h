/// @file LineDatabase.h
/// @brief The line segments that a particle carries beside its grid (Sec. III-C).
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "base/Options.h"
#include "slam/lines/LineAssociation.h"
#include "slam/lines/LineSegment.h"

namespace hybrid_slam {

/// Section [line_database].
struct LineDatabaseOptions : Options {
  double minLength = 5;  ///< m
  int minCount = 3;
  int pruneInterval = 10;
  double directionWindow = 0.5 * M_PI / 180;  ///< rad

  void describe(OptionTable& table) override;
};

struct DatabaseLine : LineSegment {
  int count = 1;     ///< how often the line was seen, its insertion included
  int inserted = 0;  ///< the number of the update that inserted it
  /// rad in [-pi/4, pi/4], modulo a right angle: the dominating direction of the lines around this one in
  /// angle. It is known better than the line's own theta, and a line that a drifting particle has just
  /// inserted takes that of the walls it should be parallel or perpendicular to.
  double direction = 0;
};

/// eq. (7) and (8): the running mean of what was seen of one line, and the ends as in Fig. 2: the two
/// farthest of the four ends, projected on the merged line.
///
/// theta is averaged across the wrap of the angle, and rho about the mean of the two middles, weighted by
/// count: printed eq. (7) counts it about the map's origin, which for a far-away line turns a small error of
/// theta into a large one of rho (doc/paper-notes.md). Both agree where that mean is at the origin, and where
/// the two lines are parallel.
DatabaseLine merged(const DatabaseLine& line, const LineSegment& seen);

/// What a line counts as evidence of its direction, m: length x min(count, 20), so that a long-known wall
/// does not outweigh all the others for ever.
double evidence(const DatabaseLine& line);

/// The direction, modulo a right angle, that lines are parallel or perpendicular to, in rad in
/// (-pi/4, pi/4]: atan2(sum w sin 4 theta, sum w cos 4 theta) / 4, w the evidence of each line. Nothing while
/// there is no line, or no direction prevails.
std::optional<double> directionModuloRightAngle(const std::vector<DatabaseLine>& lines);

/// The angle modulo a right angle, rad in [-pi/4, pi/4].
double wrapToRightAngle(double angle);
/// wrapToRightAngle(a - b) for two angles that are wrapped already; far quicker.
inline double rightAngleDifference(double a, double b) {
  const double d = a - b;
  return d > M_PI / 4 ? d - M_PI / 2 : d < -M_PI / 4 ? d + M_PI / 2 : d;
}

/// Sets each line's `direction`: the mean of the directions, modulo a right angle, that lie less than
/// `window` (rad) from its own, each weighted by its evidence x (1 - (difference / window)^2): one step of
/// mean shift with Epanechnikov's kernel (Comaniciu & Meer 2002). A building of several frames keeps them
/// apart if they differ by more than the window. With a window of 0 every line keeps its own.
void setDirections(std::vector<DatabaseLine>& lines, double window);

/// The line database of one particle, in the map frame. Copied with its particle: one contiguous block.
class LineDatabase {
 public:
  LineDatabase() = default;
  /// Of lines as lines() has them.
  explicit LineDatabase(std::vector<DatabaseLine> lines);

  /// One step of Sec. III-C: search, insertion, update, and every pruneInterval steps pruning.
  ///
  /// A line seen now that matches a database line is merged into the closest one; otherwise it is inserted if
  /// it is at least minLength long. Pruning drops lines with a count below minCount, but none that has been
  /// there for fewer than pruneInterval steps: each has that many chances to be seen again.
  void update(const std::vector<LineSegment>& seen, const LineDatabaseOptions& options,
              const AssociationOptions& association);

  const std::vector<DatabaseLine>& lines() const { return lines_; }

  /// The line that a segment seen now (map frame) belongs to, or null.
  const DatabaseLine* closestMatch(const LineSegment& seen, const AssociationOptions& association) const;

  /// directionModuloRightAngle of the lines, computed once per update.
  std::optional<double> dominatingDirection() const { return dominatingDirection_; }

 private:
  void prune(const LineDatabaseOptions& options);

  std::vector<DatabaseLine> lines_;
  std::optional<double> dominatingDirection_;
  int updates_ = 0;
};

}  // namespace hybrid_slam
