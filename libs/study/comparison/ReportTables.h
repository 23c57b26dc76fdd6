/// @file ReportTables.h
/// @brief The report's tables.
#pragma once

#include <string>
#include <vector>

#include "study/comparison/Summary.h"

namespace hybrid_slam::comparison {

/// Success, number of runs, and median and quartiles of every figure present. With a success criterion, the
/// errors of a group with successes and failures start with the median over its successful runs.
std::string summaryTable(const std::vector<Group>& groups, const std::vector<GroupSummary>& summaries,
                         const std::vector<Figure>& figures, bool withSuccess);

/// One row per group except the first: median ratios with intervals, and the p-values of the tests. Empty for
/// one group.
std::string pairedTable(const std::vector<Group>& groups, const std::vector<GroupSummary>& summaries);

/// Failed runs with their errors; empty if there are none.
std::string failureTable(const std::vector<Group>& groups, const std::vector<RunResult>& results);

}  // namespace hybrid_slam::comparison
