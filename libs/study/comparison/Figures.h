/// @file Figures.h
/// @brief The figures of one run: a row of results.csv.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "study/comparison/Groups.h"

namespace hybrid_slam::comparison {

enum class Figure {
  transMean,    ///< relations metric, translation
  rotMean,      ///< relations metric, rotation
  ate,          ///< after rigid alignment, root of the mean square
  returnTrans,  ///< from the first scan's pose to the last one's
  returnRot,
  wallMean,  ///< occupied cells to the nearest wall
  wallP95,
  doubledShare,  ///< of the walls shown, that are drawn twice
  success,       ///< 1 or 0
  wallTime,      ///< of the clock
  cpuTime,
  peakMemory,
  realtimeFactor,
  lines,     ///< in the best particle's database
  stdAlong,  ///< particle spread: mean over the filter's updates
  stdAcross,
  stdPhi,
  revisitMedian,  ///< where a scan sees again what earlier ones saw; nothing for a run without revisits
  revisits        ///< scans that do
};
constexpr size_t kFigures = 19;

struct FigureName {
  Figure figure;
  const char* column;  ///< in results.csv
  const char* title;   ///< for people
  const char* unit;    ///< "m", "deg", ...; empty for shares and counts
  bool isError;        ///< the smaller the better, and tested between groups
};
/// In the order of the columns.
extern const std::array<FigureName, kFigures> kFigureNames;

/// What one run came to.
struct RunResult {
  Run run;
  enum class Status { done, failed, missing } status = Status::missing;
  std::string error;  ///< of a failed run
  std::array<std::optional<double>, kFigures> figures;

  std::optional<double>& operator[](Figure f) { return figures[static_cast<size_t>(f)]; }
  const std::optional<double>& operator[](Figure f) const { return figures[static_cast<size_t>(f)]; }
};

const char* statusName(RunResult::Status status);

/// A number as tables show it: 6 significant digits, empty for none.
std::string cell(const std::optional<double>& value);

/// `method,variant,particles,seed,status`, then a column for each figure; one row a run.
void writeResults(const std::vector<Group>& groups, const std::vector<RunResult>& results, std::ostream& out);

}  // namespace hybrid_slam::comparison
