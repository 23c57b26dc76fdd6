/// @file BeamAngles.h
/// @brief At which angles a laser's beams go out, for logs that give nothing but the number of readings.
#pragma once

#include <cstddef>
#include <optional>

namespace hybrid_slam::readings {

/// Beam i leaves at first + i * step (rad, in the laser's frame: x ahead, counter-clockwise from above).
struct BeamAngles {
  double first = 0;
  double step = 0;
};

/// The step (rad) that goes with a number of beams in the lasers that such logs were made with; empty for
/// a number that none of them gives.
///
/// SICK PLS and LMS: 1 deg for 100, 101, 180 and 181 beams; 0.5 deg for 200, 201, 360 and 361; 0.25 deg
/// for 400, 401, 720 and 721. SICK S300: 0.5 deg for 540 and 541. Hokuyo URG: 360/1024 deg for 682, 683,
/// 726 and 769. Hokuyo UTM: 0.25 deg for 1080 and 1081.
std::optional<double> angularStepFor(size_t beams);

/// An odd number of beams lies symmetric about the laser's axis. An even number lacks the last beam at the
/// left end, so that beam n/2 looks straight ahead: 180 beams of 1 deg go from -90 to +89 deg.
BeamAngles beamAngles(size_t beams, double step);

}  // namespace hybrid_slam::readings
