/// @file ReportTables.h
/// @brief The report's tables.
#pragma once

#include <string>
#include <vector>

#include "study/comparison/Summary.h"

namespace hybrid_slam::comparison {

/// Success, runs and, for each figure that any group has, median and quartiles; with success, an error of a
/// group with successes and failures begins with the median over its successful runs.
std::string summaryTable(const std::vector<Group>& groups, const std::vector<GroupSummary>& summaries,
                         const std::vector<Figure>& figures, bool withSuccess);

/// A row for each group but the first: median ratios with their intervals, and the tests' p. Empty for one
/// group.
std::string pairedTable(const std::vector<Group>& groups, const std::vector<GroupSummary>& summaries);

/// Failed runs with their errors; empty if there are none.
std::string failureTable(const std::vector<Group>& groups, const std::vector<RunResult>& results);

}  // namespace hybrid_slam::comparison
