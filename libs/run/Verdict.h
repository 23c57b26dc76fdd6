/// @file Verdict.h
/// @brief Whether the map of a run can be trusted, judged by the scans alone.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "slam/loops/LaserAgreement.h"
#include "slam/loops/RevisitCheck.h"

namespace hybrid_slam::run {

/// A part of the path whose scans contradict what was mapped there before.
struct DoubtfulPlace {
  mrpt::math::TPoint2D at;  ///< m, map frame: its middle
  size_t update = 0;        ///< index of the path: its middle
  double length = 0;        ///< m of path
};

/// The verdict on a map, with its reasons (doc/verdict.md).
struct Verdict {
  enum class Level { consistent, doubtful, lost };

  Level level = Level::consistent;
  std::vector<std::string> reasons;   ///< short sentences
  std::vector<DoubtfulPlace> places;  ///< at most ten; returning stretches before jumps, the longest first
  /// Whether scans contradict the map, be it only with beams at narrow things, which do not count for the
  /// level: people and chairs move, but another run of the same log may be better.
  bool isContradicted = false;
  double contradiction = 0;  ///< contradicted share of the returning scans, plus that of the recent ones

  /// Whether the map is worse than another one of the same log: by its level; if equal, it is contradicted
  /// and the other one is not, or it is contradicted more.
  bool isWorseThan(const Verdict& other) const;
  std::string name() const;
  /// One line: `verdict: doubtful: REASON; REASON; longest at (X, Y) m`.
  std::string line() const;
};

/// Turns of over 3 deg between two updates, by the odometry.
struct Turns {
  size_t all = 0;
  size_t against = 0;  ///< the path turns at least half as far in the other direction
};
/// @param odometry  motion from each update to the next one, at the index of the next
/// @param path      a pose for each update
Turns turnsOf(const std::vector<mrpt::math::TPose2D>& odometry, const std::vector<mrpt::math::TPose2D>& path);

/// A part of the path without scans.
struct Gap {
  double length = 0;           ///< m, along the odometry
  mrpt::math::TPoint2D start;  ///< m, map frame
};

/// Evidence that a verdict is based on.
struct Evidence {
  std::vector<Revisit> returning;   ///< scans compared with what was mapped 20 m of path before
  std::vector<Revisit> recent;      ///< scans compared with what was mapped 2 m of path before
  std::vector<Revisit> earlier;     ///< scans compared with the map that the run continues
  std::vector<LaserOffset> lasers;  ///< how the lasers fit each other
  double spread = 0;                ///< m, standard deviation of the particles at the end
  size_t slips = 0, updates = 0;    ///< updates whose odometry was rejected, and all
  size_t odometryFaults = 0;        ///< impossible odometry readings, and jumps
  Turns turns;                      ///< in both directions
  size_t scans = 0;                 ///< of the log
  double beams = NAN;               ///< mean number of beams compared in a scan, at most 90; NaN: no scan
  double spacing = 0;               ///< m of path between two updates, mean
  Gap gap;                          ///< the longest
  size_t early = 0;                 ///< scans of the log before its first odometry, which are not used
  std::string notCompared;  ///< why the scans were not compared to the end of the run; empty: they were
};

/// Share of the scans that may contradict the map that a run continues: buildings change between runs.
constexpr double kMostAgainstEarlierMap = 0.3;

/// The rules and thresholds of doc/verdict.md.
Verdict verdictOf(const Evidence& evidence);

}  // namespace hybrid_slam::run
