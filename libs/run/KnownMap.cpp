#include "run/KnownMap.h"

#include <cmath>

#include "base/Errors.h"
#include "base/Numbers.h"
#include "run/MapReader.h"
#include "run/SessionFile.h"

namespace hybrid_slam::run {

ScanMap readKnownMap(const std::string& file) {
  if (isSession(file)) return SessionReader(file).header().map;
  return {readMap(file), LineDatabase()};
}

std::optional<ScanMap> mapOfEarlierRun(Configuration& configuration) {
  const RunOptions& run = configuration.run;
  const std::string& file = run.continueFrom.empty() ? run.localizeIn : run.continueFrom;
  if (!run.priorPlan.empty() && run.method != RunOptions::Method::hybrid)
    throw InputError("a floor plan is a prior on lines", "option --prior-plan", "expected method hybrid");
  if (file.empty()) return std::nullopt;
  if (run.method != RunOptions::Method::hybrid && run.method != RunOptions::Method::general)
    throw InputError("method " + nameOf(run.method) + " does not take a map", file,
                     "expected method hybrid or general");
  ScanMap map = readKnownMap(file);
  const double cell = map.grid.resolution();
  configuration.setDefault("grid", "resolution", numberText(cell));
  if (std::abs(configuration.filter.grid.resolution - cell) > 1e-9)
    throw InputError("another cell size than the map's", "section [grid], key `resolution`",
                     "expected " + numberText(cell) + " m as in " + file);
  configuration.filter.grid.resolution = cell;
  if (!run.continueFrom.empty()) map.grid.limit(0.2, 0.8);
  return map;
}

}  // namespace hybrid_slam::run
