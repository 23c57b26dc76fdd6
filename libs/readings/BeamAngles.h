/// @file BeamAngles.h
/// @brief Beam angles of a laser, for logs that give only the number of readings.
#pragma once

#include <cstddef>
#include <optional>

namespace hybrid_slam::readings {

/// Beam i has the angle first + i * step (rad, laser frame: x forwards, counter-clockwise seen from above).
struct BeamAngles {
  double first = 0;
  double step = 0;
};

/// Returns the angular step (rad) of the known laser with this number of beams; empty if there is none.
///
/// SICK PLS and LMS: 1 deg for 100, 101, 180 and 181 beams; 0.5 deg for 200, 201, 360 and 361; 0.25 deg
/// for 400, 401, 720 and 721. SICK S300: 0.5 deg for 540 and 541. Hokuyo URG: 360/1024 deg for 682, 683,
/// 726 and 769. Hokuyo UTM: 0.25 deg for 1080 and 1081.
std::optional<double> angularStepFor(size_t beams);

/// Returns the angles of `beams` beams. An odd number of beams is symmetric about the laser's axis. An even
/// number lacks the leftmost beam, so that beam n/2 points straight ahead: 180 beams at 1 deg span -90 to +89
/// deg.
BeamAngles beamAngles(size_t beams, double step);

}  // namespace hybrid_slam::readings
