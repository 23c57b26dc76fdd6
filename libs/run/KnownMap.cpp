#include "run/KnownMap.h"

#include <algorithm>
#include <cmath>

#include "base/Errors.h"
#include "base/Numbers.h"
#include "files/LineReader.h"
#include "run/MapReader.h"
#include "run/RosMapFile.h"
#include "run/SessionFile.h"

namespace hybrid_slam::run {
namespace {

/// Rejects a start from where the laser would see nothing of the map.
void expectInView(const mrpt::math::TPose2D& start, const OccupancyGrid& grid, double maxRange,
                  const std::string& file) {
  const CellBox box = grid.tiles().bounds();
  if (box.empty()) return;
  const double cell = grid.resolution();
  const double xMin = cell * box.min.x, xMax = cell * box.max.x, yMin = cell * box.min.y,
               yMax = cell * box.max.y;
  if (std::max({xMin - start.x, start.x - xMax, yMin - start.y, start.y - yMax}) > maxRange)
    throw InputError("start out of view of the map", "command line, option --start",
                     "expected at most " + numberText(maxRange) + " m (grid.max_range) outside x from " +
                         numberText(std::round(xMin)) + " to " + numberText(std::round(xMax)) +
                         " m, y from " + numberText(std::round(yMin)) + " to " +
                         numberText(std::round(yMax)) + " m, the map of " + file);
}

}  // namespace

ScanMap readKnownMap(const std::string& file) {
  if (isSession(file)) return SessionReader(file).header().map;
  return {readMap(file), LineDatabase()};
}

std::vector<std::string> filesOfMap(const std::string& map) {
  if (map.empty()) return {};
  const std::string file = sessionIn(map);
  if (isSession(file) || !files::isText(file)) return {file};
  return {file, readRosMapFile(file).picture};
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
  if (run.start) expectInView(*run.start, map.grid, configuration.filter.grid.maxRange, file);
  if (!run.continueFrom.empty()) map.grid.limit(0.2, 0.8);
  return map;
}

}  // namespace hybrid_slam::run
