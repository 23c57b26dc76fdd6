/// @file Figures.h
/// @brief The figures of one run: a row of results.csv.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "study/comparison/Groups.h"

namespace hybrid_slam::comparison {

/// The figures of a run.
enum class Figure {
  transMean,    ///< relations metric, translation
  rotMean,      ///< relations metric, rotation
  ate,          ///< after rigid alignment, root of the mean square
  returnTrans,  ///< motion from the first to the last scan
  returnRot,
  wallMean,  ///< occupied cells to the nearest wall
  wallP95,
  doubledShare,  ///< of the shown walls
  success,       ///< 1 or 0
  wallTime,      ///< elapsed
  cpuTime,
  peakMemory,
  realtimeFactor,
  lines,     ///< in the best particle's database
  stdAlong,  ///< particle spread: mean over the filter's updates
  stdAcross,
  stdPhi,
  revisitMedian,  ///< at revisited places; empty for a run without revisits
  revisits        ///< number of revisiting scans
};
constexpr size_t kFigures = 19;

/// How a figure is written.
struct FigureName {
  Figure figure;
  const char* column;  ///< in results.csv
  const char* title;   ///< in the report
  const char* unit;    ///< "m", "deg", ...; empty for shares and counts
  bool isError;        ///< smaller is better; tested between groups
};
/// Names of the figures in column order.
extern const std::array<FigureName, kFigures> kFigureNames;

/// Result of one run.
struct RunResult {
  Run run;
  enum class Status { done, failed, missing } status = Status::missing;
  std::string error;  ///< if the run failed
  std::array<std::optional<double>, kFigures> figures;

  std::optional<double>& operator[](Figure f) { return figures[static_cast<size_t>(f)]; }
  const std::optional<double>& operator[](Figure f) const { return figures[static_cast<size_t>(f)]; }
};

/// Returns the status as in results.csv.
const char* statusName(RunResult::Status status);

/// Formats a number for tables: 6 significant digits, empty if missing.
std::string cell(const std::optional<double>& value);

/// `method,variant,particles,seed,status`, then one column per figure; one row per run.
void writeResults(const std::vector<Group>& groups, const std::vector<RunResult>& results, std::ostream& out);

}  // namespace hybrid_slam::comparison
