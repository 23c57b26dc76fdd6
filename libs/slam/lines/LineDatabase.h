/// @file LineDatabase.h
/// @brief The line segments of a particle's map (Sec. III-C).
#pragma once

#include <mrpt/core/bits_math.h>

#include <algorithm>
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
  double directionWindow = mrpt::DEG2RAD(0.5);  ///< rad

  void describe(OptionTable& table) override;
};

/// Largest number of updates of a run, far below the greatest int.
constexpr int kMostUpdates = 1'000'000'000;

/// A line of the map, merged from its observations.
struct DatabaseLine : LineSegment {
  int count = 1;     ///< number of observations, including the first
  int inserted = 0;  ///< update that inserted it
  /// rad in [-pi/4, pi/4], modulo 90 deg: dominating direction of the lines with similar directions. It is
  /// more precise than the line's theta, and a line newly inserted by a drifting particle takes the direction
  /// of the walls it should be parallel or perpendicular to.
  double direction = 0;

  template <class State>
  void visit(State& state) {
    LineSegment::visit(state);
    state(count, inserted, direction);
    state.check(1 <= count && count <= kMostUpdates && -kMostUpdates <= inserted &&
                    inserted <= kMostUpdates && std::abs(direction) < 4,
                "a line is impossible");
  }
};

/// eq. (7) and (8): the running mean of a line's observations. The ends are the two farthest of the four
/// ends, projected onto the merged line (Fig. 2).
///
/// theta is averaged across the angle wrap. rho is averaged about the mean of the two midpoints, weighted by
/// count; eq. (7) as printed measures it from the map's origin, which for a distant line turns a small error
/// of theta into a large one of rho (doc/paper-notes.md). Both agree if that mean is the origin or the lines
/// are parallel.
/// @param observations  of `seen`: 1, or those of a line of another database
DatabaseLine merged(const DatabaseLine& line, const LineSegment& seen, int observations = 1);

/// The line database of one particle, in the map frame. One contiguous block, copied with its particle.
class LineDatabase {
 public:
  LineDatabase() = default;
  /// Begins with known lines, whose age counts from now.
  explicit LineDatabase(std::vector<DatabaseLine> lines);

  /// One step of Sec. III-C: search, insertion, update, and pruning every pruneInterval steps.
  ///
  /// An observed line that matches is merged into the closest database line; otherwise it is inserted if it
  /// is at least minLength long. Pruning removes lines with a count below minCount, except those younger than
  /// pruneInterval steps.
  void update(const std::vector<LineSegment>& seen, const LineDatabaseOptions& options,
              const AssociationOptions& association);

  const std::vector<DatabaseLine>& lines() const { return lines_; }

  /// The database line closest to an observed segment (map frame), or null if none matches.
  const DatabaseLine* closestMatch(const LineSegment& seen, const AssociationOptions& association) const;

  /// directionModuloRightAngle of the lines, computed once per update.
  std::optional<double> dominatingDirection() const { return dominatingDirection_; }
  /// Sum of evidence() over the lines, m.
  double totalEvidence() const { return totalEvidence_; }

  template <class State>
  void visit(State& state) {
    state(lines_, updates_);
    state.check(0 <= updates_ && updates_ <= kMostUpdates, "the lines have an impossible age");
    if constexpr (State::kIsReading) sum();
  }

 private:
  void prune(const LineDatabaseOptions& options);
  /// Computes dominating direction and total evidence of the lines.
  void sum();

  std::vector<DatabaseLine> lines_;
  std::optional<double> dominatingDirection_;
  double totalEvidence_ = 0;
  int updates_ = 0;
};

}  // namespace hybrid_slam
