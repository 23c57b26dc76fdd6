#include "run/MapReader.h"

#include "base/Errors.h"
#include "files/GridMapReader.h"
#include "files/InputFile.h"
#include "files/LineReader.h"
#include "files/ObjectLayouts.h"
#include "run/RosMap.h"
#include "slam/grid/GridConversion.h"

namespace hybrid_slam::run {

static_assert(files::kMostGridMapCells == kMostCells);

OccupancyGrid readMap(const std::string& file) {
  constexpr const char* kExpected =
      "expected a session.hslam, the map.yaml of ROS's map_server or a grid map of MRPT";
  files::expectFile(file, kExpected);
  if (files::isText(file)) return readRosMap(file);  // a grid map starts with zeros
  OccupancyGrid grid = fromMrpt(files::readGridMap(file));
  if (!(grid.resolution() >= 0.001 && grid.resolution() <= 10))
    throw InputError("grid map with impossible cells", file, "expected 0.001 .. 10 m per cell");
  return grid;
}

}  // namespace hybrid_slam::run
