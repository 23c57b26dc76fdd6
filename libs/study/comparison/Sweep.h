/// @file Sweep.h
/// @brief All runs of a comparison, with the identity and the command of each.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "readings/RawlogSource.h"
#include "run/LogSettings.h"
#include "study/comparison/Comparison.h"
#include "study/comparison/RunSetup.h"

namespace hybrid_slam::comparison {

/// Called with what a group takes of the log.
using LogReport = std::function<void(const Group& group, const readings::RawlogSummary& log,
                                     const run::LogSettings& settings)>;

/// Adds identity and command to each run. The identity has the settings that hybrid-slam will derive from the
/// log, which is read once for each different [input] section.
/// @param folder   holds the folders of the runs
/// @param program  hybrid-slam
/// @param report   called once for each different [input] section, with the first group that has it
/// @throws InputError for a wrong INI file, setting or log
/// @throws std::runtime_error if `stop` becomes true while the log is read
std::vector<ComparisonRun> makeSweep(const CommonSetup& common, const std::vector<Group>& groups,
                                     const std::vector<Run>& runs, const std::filesystem::path& folder,
                                     const std::string& program, const std::atomic<bool>& stop,
                                     const LogReport& report = {});

}  // namespace hybrid_slam::comparison
