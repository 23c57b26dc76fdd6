/// @file MappedRoom.h
/// @brief For the tests: a particle that has mapped its surroundings, and scans of them.
#pragma once

#include <mrpt/math/wrap2pi.h>

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

/// A particle at `start` that has mapped the surrounding walls.
inline Particle particleAt(const Walls& walls, const TPose2D& start) {
  RandomStream random(1, 0, 0);
  Particle particle;
  particle.path.push(start);
  for (int i = 0; i < 40; ++i) {
    const TPose2D robot(uniform(random, -1, 1), uniform(random, -0.5, 0.5), uniform(random, -M_PI, M_PI));
    const PreparedScan scan = prepared(walls, robot, random);
    particle.grid.insert(scan.beams, robot, GridOptions());
    std::vector<LineSegment> lines;
    for (const LineSegment& line : scan.lines) lines.push_back(transformed(line, robot));
    particle.lines.write().update(lines, LineDatabaseOptions(), AssociationOptions());
  }
  return particle;
}

inline Eigen::Vector3d offset(const TPose2D& pose, const TPose2D& from) {
  return {pose.x - from.x, pose.y - from.y, mrpt::math::wrapToPi(pose.phi - from.phi)};
}

}  // namespace hybrid_slam::test
