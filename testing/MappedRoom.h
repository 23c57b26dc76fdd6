/// @file MappedRoom.h
/// @brief For the tests: maps of walls, a particle with such a map, and scans of the walls.
#pragma once

#include "slam/filter/Particle.h"
#include "slam/filter/PreparedScan.h"
#include "slam/grid/BeamSelection.h"
#include "testing/TestRoom.h"

namespace hybrid_slam::test {

inline const Walls kCorridor{{{-1000, -1.2}, {1000, -1.2}}, {{-1000, 1.2}, {1000, 1.2}}};

inline PreparedScan prepared(const Walls& walls, const TPose2D& robot, RandomStream& random) {
  const LaserScans scan{scanOf(walls, robot, {0.2, 0, 0}, 181, M_PI, 0.01, random)};
  const FilterConfiguration c;
  const BeamSelection selection(scan);
  return {scan, ScanBeams(scan), ScanBeams(scan, selection.take(c.gridWeight.beams)),
          ScanBeams(scan, selection.take(c.matcher.beams)), extractLines(scan[0], c.lineExtraction)};
}

struct RoomMap {
  OccupancyGrid grid;
  LineDatabase lines;
};

/// A map of the walls, made of `scans` scans from all over the area between two corners (m).
inline RoomMap mappedFrom(const TPoint2D& low, const TPoint2D& high, const Walls& walls, int scans) {
  RoomMap map;
  RandomStream random(1, 0, 0);
  for (int i = 0; i < scans; ++i) {
    const TPose2D robot(uniform(random, low.x, high.x), uniform(random, low.y, high.y),
                        uniform(random, -M_PI, M_PI));
    const PreparedScan scan = prepared(walls, robot, random);
    map.grid.insert(scan.beams, robot, GridOptions());
    map.lines.update(transformed(scan.lines, robot), LineDatabaseOptions(), AssociationOptions());
  }
  return map;
}

/// A particle at `start` that has mapped the surrounding walls.
inline Particle particleAt(const Walls& walls, const TPose2D& start) {
  const RoomMap map = mappedFrom({-1, -0.5}, {1, 0.5}, walls, 40);
  Particle particle;
  particle.path.push(start);
  particle.grid = map.grid;
  particle.lines = CowPtr<LineDatabase>(map.lines);
  return particle;
}

}  // namespace hybrid_slam::test
