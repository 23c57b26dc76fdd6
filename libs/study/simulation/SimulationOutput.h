/// @file SimulationOutput.h
/// @brief Writes a simulated log: rawlog, ground truth, floor plan of the session, picture. The same log
/// gives the same bytes.
#pragma once

#include <mrpt/obs/CRawlog.h>

#include <string>
#include <vector>

#include "study/simulation/Simulation.h"

namespace hybrid_slam::simulation {

class BuildingPlan;
struct PlacedThing;

/// Returns observations in order of time, or one (action, observation) pair per scan; the first action is
/// empty.
mrpt::obs::CRawlog toRawlog(const SimulatedLog& log, RawlogForm form);

/// Writes a gzip file without a timestamp in the header. @throws std::runtime_error if it cannot be written
void writeRawlog(const mrpt::obs::CRawlog& rawlog, const std::string& file);

/// Writes rows `timestamp x y z qx qy qz qw` (s, m). @throws std::runtime_error if it cannot be written
void writeGroundTruth(const std::vector<TruePose>& poses, const std::string& file);

/// Writes a floor plan file of single walls; the walls of a door or box have its name as a comment.
/// @throws std::runtime_error if it cannot be written
void writeFloorPlan(const BuildingPlan& fixed, const std::vector<PlacedThing>& things,
                    const std::string& file);

/// Writes a PNG: walls black, path blue, start green, end red, grid lines every 5 m.
/// @throws std::runtime_error if it cannot be written
void writePicture(const BuildingPlan& plan, const std::vector<TruePose>& poses, const std::string& file);

}  // namespace hybrid_slam::simulation
