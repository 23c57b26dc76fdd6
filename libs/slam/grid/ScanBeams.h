/// @file ScanBeams.h
/// @brief The scans of one reading prepared once for all particles: origin and direction of each beam.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/Errors.h"
#include "base/LaserScan.h"

namespace hybrid_slam {

/// The valid beams of a robot's lasers in the robot frame; only the rotation by its heading remains to be
/// computed for a particle.
struct ScanBeams {
  /// A valid beam.
  struct Ray {
    double dirX, dirY;  ///< unit vector, robot frame
    double range;       ///< m
    size_t laser;       ///< index in `origins`
    template <class State>
    void visit(State& state) {
      state(dirX, dirY, range, laser);
      state.check(std::abs(dirX) <= 1.001 && std::abs(dirY) <= 1.001 && range > 0 && range <= 1e4,
                  "a beam is impossible");
    }
  };
  std::vector<mrpt::math::TPoint2D> origins;  ///< of each laser, robot frame, m
  std::vector<Ray> rays;

  ScanBeams() = default;
  /// All beams.
  explicit ScanBeams(const LaserScan& scan) { addAll(scan); }
  explicit ScanBeams(const LaserScans& scans) {
    for (const LaserScan& scan : scans) addAll(scan);
  }
  /// The beams chosen by a BeamSelection of the same scans.
  ScanBeams(const LaserScans& scans, const std::vector<size_t>& taken) {
    rays.reserve(taken.size());
    auto next = taken.begin();
    size_t first = 0;  // index of the laser's first beam
    for (const LaserScan& scan : scans) {
      origins.emplace_back(scan.sensorPose.x, scan.sensorPose.y);
      for (; next != taken.end() && *next < first + scan.beams.size(); ++next)
        add(scan, scan.beams[*next - first]);
      first += scan.beams.size();
    }
  }

  /// Returns whether no beam is longer than `range` (m): the memory of an insertion grows with its square.
  bool areWithin(double range) const {
    return std::all_of(rays.begin(), rays.end(), [range](const Ray& ray) { return ray.range <= range; });
  }

  /// Returns at most `most` of the beams, evenly spaced.
  ScanBeams thinned(size_t most) const {
    ScanBeams some;
    some.origins = origins;
    const size_t every = (rays.size() + most - 1) / most;
    for (size_t i = 0; i < rays.size(); i += every) some.rays.push_back(rays[i]);
    return some;
  }

  /// Returns the end points of the beams, robot frame, m.
  std::vector<mrpt::math::TPoint2D> endPoints() const {
    std::vector<mrpt::math::TPoint2D> points;
    points.reserve(rays.size());
    for (const Ray& ray : rays)
      points.push_back(origins[ray.laser] + mrpt::math::TPoint2D(ray.dirX, ray.dirY) * ray.range);
    return points;
  }

  template <class State>
  void visit(State& state) {
    state(origins, rays);
    state.check(origins.size() <= kMaxLasers, "too many lasers");
    for (const Ray& ray : rays) state.check(ray.laser < origins.size(), "a beam of no laser");
    for (const mrpt::math::TPoint2D& at : origins)
      state.check(at.norm() <= kMaxSensorDistance, "a laser is not on the robot");
  }

 private:
  void addAll(const LaserScan& scan) {
    origins.emplace_back(scan.sensorPose.x, scan.sensorPose.y);
    for (const Beam& beam : scan.beams)
      if (beam.valid) add(scan, beam);
  }
  void add(const LaserScan& scan, const Beam& beam) {
    const double heading = scan.sensorPose.phi + beam.angle;
    rays.push_back({std::cos(heading), std::sin(heading), beam.range, origins.size() - 1});
  }
};

/// Returns whether a pose is near enough to the map's origin, 10,000 km, for its cells to have a number.
inline bool isInReach(const mrpt::math::TPose2D& pose) {
  constexpr double kReach = 1e7;  // m; 1e9 cells of 1 cm
  return std::abs(pose.x) <= kReach && std::abs(pose.y) <= kReach;
}

/// A robot pose in units of cells, with its sine, its cosine and the lasers' positions computed once.
struct GridPose {
  /// @throws InputError for a pose out of reach
  GridPose(const mrpt::math::TPose2D& robot, const ScanBeams& scan, double cellSize)
      : cosPhi(std::cos(robot.phi)), sinPhi(std::sin(robot.phi)) {
    if (!isInReach(robot))
      throw InputError("the map is too large", "poses of the robot",
                       "expected them within 10,000 km of the map's origin");
    for (size_t i = 0; i < scan.origins.size(); ++i) {
      const mrpt::math::TPoint2D& at = scan.origins[i];
      origins[i] = {(robot.x + cosPhi * at.x - sinPhi * at.y) / cellSize,
                    (robot.y + sinPhi * at.x + cosPhi * at.y) / cellSize};
    }
  }
  const mrpt::math::TPoint2D& origin(const ScanBeams::Ray& ray) const { return origins[ray.laser]; }
  double dirX(const ScanBeams::Ray& ray) const { return cosPhi * ray.dirX - sinPhi * ray.dirY; }
  double dirY(const ScanBeams::Ray& ray) const { return sinPhi * ray.dirX + cosPhi * ray.dirY; }

  double cosPhi, sinPhi;
  std::array<mrpt::math::TPoint2D, kMaxLasers> origins;  ///< the lasers in the map frame, in cells
};

}  // namespace hybrid_slam
