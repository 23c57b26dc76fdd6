/// @file Sweep.h
/// @brief All runs of a comparison, with the identity and the command of each.
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "study/comparison/Comparison.h"
#include "study/comparison/RunSetup.h"

namespace hybrid_slam::comparison {

/// Adds identity and command to each run. The identity has the settings that hybrid-slam will derive from the
/// log, which is read once for each different [input] section.
/// @param folder   holds the folders of the runs
/// @param program  hybrid-slam
/// @throws InputError for a wrong INI file, setting or log
/// @throws std::runtime_error if `stop` becomes true while the log is read
std::vector<ComparisonRun> makeSweep(const CommonSetup& common, const std::vector<Group>& groups,
                                     const std::vector<Run>& runs, const std::filesystem::path& folder,
                                     const std::string& program, const std::atomic<bool>& stop);

}  // namespace hybrid_slam::comparison
