/// @file LaserAgreement.h
/// @brief Compares what the lasers of a robot see, to find a wrong heading of a laser on the robot.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/LaserScan.h"
#include "slam/grid/ScanBeams.h"

namespace hybrid_slam {

/// How the scans of a laser fit those of another one.
struct LaserOffset {
  std::string laser, reference;  ///< labels
  double turn = 0;               ///< rad, after which the laser's scans fit: the median of all matches
  size_t scans = 0;              ///< matched
  /// Whether the lasers see different walls: a map of both is bent.
  bool isLarge() const;
};

/// Matches the scans of each laser to those that the first one takes within 2.5 m of path. If the poses of
/// the lasers on the robot are right, they fit as they are; if one has a wrong heading, the same turn is
/// needed everywhere. Only the turn is judged: along a corridor, the position of a match is arbitrary.
class LaserAgreement {
 public:
  /// @param maxRange  m, of the beams compared
  explicit LaserAgreement(double maxRange) : maxRange_(maxRange) {}

  /// @param pose  of the robot, map frame; @param distance  m, along the path
  void add(const mrpt::math::TPose2D& pose, const Scans& scans, double distance);
  /// Returns the offsets of lasers with at least 20 matched scans.
  std::vector<LaserOffset> offsets() const;

 private:
  struct Seen {
    std::string laser;
    mrpt::math::TPose2D pose;
    double distance;
    ScanBeams beams;
  };
  void matchToReference(const Seen& seen);

  double maxRange_;
  std::optional<std::string> reference_;              ///< label of the first laser
  std::deque<Seen> seen_;                             ///< within the window, by distance
  size_t matched_ = 0;                                ///< of these, from the first on
  std::map<std::string, mrpt::math::TPose2D> last_;   ///< pose of each laser's newest scan
  std::map<std::string, std::vector<double>> turns_;  ///< of each match
};

}  // namespace hybrid_slam
