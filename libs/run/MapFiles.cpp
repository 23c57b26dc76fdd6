#include "run/MapFiles.h"

#include <iomanip>

#include "files/RawlogWriter.h"
#include "run/MapPicture.h"
#include "slam/lines/LineTable.h"

namespace hybrid_slam::run {

using mrpt::maps::COccupancyGridMap2D;

void savePicture(const files::OutputFolder& folder, const COccupancyGridMap2D& grid,
                 const files::Trajectory& trajectory, const std::vector<DatabaseLine>& lines,
                 const std::vector<DoubtfulPlace>& doubtful) {
  const std::string png = mapPicture(MapRaster(grid, trajectory), {trajectory, lines, doubtful});
  folder.write("map.png", [&png](std::ostream& out) { out << png; });
}

void saveRosMap(const files::OutputFolder& folder, const COccupancyGridMap2D& grid,
                const files::Trajectory& trajectory) {
  const MapRaster map(grid, trajectory);
  folder.write("map.pgm", [&map](std::ostream& out) {
    out << "P5\n" << map.width() << " " << map.height() << "\n255\n";
    for (int y = 0; y < map.height(); ++y) out.write(reinterpret_cast<const char*>(map.row(y)), map.width());
  });
  // map_server takes a cell for unknown if its darkness, here 50 / 255, is between the thresholds.
  folder.write("map.yaml", [&map](std::ostream& out) {
    out << std::setprecision(10) << "image: map.pgm\nresolution: " << map.cell() << "\norigin: ["
        << map.left() << ", " << map.bottom()
        << ", 0.0]\nnegate: 0\noccupied_thresh: " << MapRaster::kOccupiedThreshold
        << "\nfree_thresh: 0.196\n";
  });
}

void saveGridMap(const files::OutputFolder& folder, const COccupancyGridMap2D& grid) {
  files::RawlogWriter file(folder.path("map.gridmap.gz"));
  file.write(grid);
  file.finish();
}

void saveLines(const files::OutputFolder& folder, const std::vector<DatabaseLine>& lines) {
  folder.write("lines.csv", [&lines](std::ostream& out) { writeLineTable(lines, out); });
}

}  // namespace hybrid_slam::run
