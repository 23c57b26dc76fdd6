/// @file SimulationOutput.h
/// @brief A simulated log into files: rawlog, ground truth, picture. The same log gives the same bytes.
#pragma once

#include <mrpt/obs/CRawlog.h>

#include <string>
#include <vector>

#include "study/simulation/Simulation.h"

namespace hybrid_slam::simulation {

class FloorPlan;

/// Observations in order of time, or one (action, observation) pair a scan, the first action being none.
mrpt::obs::CRawlog toRawlog(const SimulatedLog& log, RawlogForm form);

/// Compressed by gzip, without a time in its header. @throws std::runtime_error if it cannot be written
void writeRawlog(const mrpt::obs::CRawlog& rawlog, const std::string& file);

/// Rows `timestamp x y z qx qy qz qw` (s, m). @throws std::runtime_error if it cannot be written
void writeGroundTruth(const std::vector<TruePose>& poses, const std::string& file);

/// Walls black, path blue, its start green and its end red, a grid line every 5 m; PNG.
/// @throws std::runtime_error if it cannot be written
void writePicture(const FloorPlan& plan, const std::vector<TruePose>& poses, const std::string& file);

}  // namespace hybrid_slam::simulation
