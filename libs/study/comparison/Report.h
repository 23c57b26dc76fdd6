/// @file Report.h
/// @brief report.html: one self-contained file with tables, plots and maps, without scripts.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "study/comparison/RunEvaluation.h"
#include "study/comparison/Summary.h"

namespace hybrid_slam::comparison {

/// What the report is about.
struct ReportInput {
  std::string command;  ///< command line
  std::string version;
  std::string config;  ///< the INI file
  std::string log;
  double logDuration = 0;             ///< s
  std::vector<std::string> settings;  ///< common to all runs, on top of the INI file
  std::vector<Group> groups;
  std::vector<RunResult> results;
  std::vector<GroupSummary> summaries;
  GroundTruth truth;
  std::filesystem::path runs;  ///< parent of the run folders
};

/// Writes XHTML. Trajectories, spreads and maps are read from the folders of the finished runs.
/// @returns one line that says why plots are missing, such as for lack of gnuplot; empty if none are
std::string writeReport(const ReportInput& input, std::ostream& out);

}  // namespace hybrid_slam::comparison
