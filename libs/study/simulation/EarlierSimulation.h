/// @file EarlierSimulation.h
/// @brief Distinguishes an earlier simulation, which may be replaced, from other files of its name.
#pragma once

#include <filesystem>

namespace hybrid_slam::simulation {

/// The files of a simulated log.
struct SimulationFiles {
  explicit SimulationFiles(const std::filesystem::path& rawlog);
  std::filesystem::path rawlog, truth, picture;
  std::filesystem::path plan;  ///< only with movable things
};

/// @param startTime  UNIX time of the first scan, s: exactly that of a simulation's rawlog and truth
/// @throws InputError if a file exists, is not empty and is not of an earlier simulation with this start time
void expectReplaceable(const SimulationFiles& files, double startTime);

}  // namespace hybrid_slam::simulation
