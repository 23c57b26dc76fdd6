#include "run/MapReader.h"

#include <filesystem>

#include "base/Errors.h"
#include "files/GridMapReader.h"
#include "files/LineReader.h"
#include "files/ObjectLayouts.h"
#include "run/RosMap.h"
#include "slam/grid/GridConversion.h"

namespace hybrid_slam::run {
namespace {

static_assert(files::kMostGridMapCells == kMostCells);

/// A map of MRPT has zeros at its start.
bool isRosMap(const std::string& file) {
  return std::filesystem::is_regular_file(file) && files::isText(file);
}

}  // namespace

OccupancyGrid readMap(const std::string& file) {
  if (isRosMap(file)) return readRosMap(file);
  OccupancyGrid grid = fromMrpt(files::readGridMap(file));
  if (!(grid.resolution() >= 0.001 && grid.resolution() <= 10))
    throw InputError("grid map with impossible cells", file, "expected 0.001 .. 10 m per cell");
  return grid;
}

}  // namespace hybrid_slam::run
