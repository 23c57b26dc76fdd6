/// @file LineDatabase.h
/// @brief The line segments that a particle carries beside its grid (Sec. III-C).
#pragma once

#include <optional>
#include <vector>

#include "base/Options.h"
#include "lines/LineAssociation.h"
#include "lines/LineSegment.h"

namespace hybrid_slam {

/// Section [line_database].
struct LineDatabaseOptions : Options {
  double minLength = 5;  ///< m
  int minCount = 3;
  int pruneInterval = 10;

  void describe(OptionTable& table) override;
};

struct DatabaseLine : LineSegment {
  int count = 1;     ///< how often the line was seen, its insertion included
  int inserted = 0;  ///< the number of the update that inserted it
};

/// eq. (7) and (8): the running mean of what was seen of one line, and the ends as in Fig. 2: the two
/// farthest of the four ends, projected on the merged line.
///
/// theta is averaged across the wrap of the angle, and rho about the mean of the two middles, weighted by
/// count: printed eq. (7) counts it about the map's origin, which for a far-away line turns a small error of
/// theta into a large one of rho (doc/paper-notes.md). Both agree where that mean is at the origin, and where
/// the two lines are parallel.
DatabaseLine merged(const DatabaseLine& line, const LineSegment& seen);

/// The direction, modulo a right angle, that lines are parallel or perpendicular to, in rad in
/// (-pi/4, pi/4]: atan2(sum w sin 4 theta, sum w cos 4 theta) / 4, w = length * min(count, 20), so that a
/// long-known wall does not outweigh all the others for ever. Nothing while there is no line, or none
/// prevails.
std::optional<double> directionModuloRightAngle(const std::vector<DatabaseLine>& lines);

/// The line database of one particle, in the map frame. Copied with its particle: one contiguous block.
class LineDatabase {
 public:
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
