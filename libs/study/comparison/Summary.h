/// @file Summary.h
/// @brief Summary of each group of runs, and its comparison with the first group.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <ostream>
#include <vector>

#include "study/comparison/Figures.h"
#include "study/comparison/Statistics.h"

namespace hybrid_slam::comparison {

/// One figure over the finished runs of a group.
struct FigureSummary {
  size_t runs = 0;
  std::optional<Quartiles> quartiles;  ///< empty without runs
  /// For errors only: number and median of the successful runs. A median over successes and failures
  /// describes neither.
  size_t successfulRuns = 0;
  std::optional<double> successfulMedian;
};

/// One figure of a group against the first group, over the seeds finished by both.
struct PairedComparison {
  size_t pairs = 0;
  std::optional<MedianRatio> ratio;  ///< this group's median / the first group's
  double wilcoxonP = 1, signP = 1;   ///< two-sided
};

/// The summary of one group.
struct GroupSummary {
  size_t done = 0, failed = 0;
  /// Number of successes among finished and failed runs: a failed run is not a success. Empty without a
  /// criterion.
  std::optional<size_t> successes;
  double successRate = 0;
  Interval successInterval;  ///< Wilson, 95 %
  double successSignP = 1;   ///< against the first group: McNemar's exact test over common seeds
  std::array<FigureSummary, kFigures> figures;
  std::array<std::optional<PairedComparison>, kFigures> paired;  ///< errors only; empty for the first group

  size_t ended() const { return done + failed; }
  bool hasSuccessesAndFailures() const { return successes && *successes > 0 && *successes < ended(); }
};

/// @param results  all runs; groups are in order of their numbers
std::vector<GroupSummary> groupSummaries(size_t groups, const std::vector<RunResult>& results);

/// One row per group and figure.
void writeSummary(const std::vector<Group>& groups, const std::vector<GroupSummary>& summaries,
                  std::ostream& out);
/// Returns the same as a tree.
nlohmann::ordered_json summaryJson(const std::vector<Group>& groups,
                                   const std::vector<GroupSummary>& summaries);

}  // namespace hybrid_slam::comparison
