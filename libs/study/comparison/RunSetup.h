/// @file RunSetup.h
/// @brief The INI file and settings of each run of a comparison.
#pragma once

#include <string>
#include <vector>

#include "run/Configuration.h"
#include "study/comparison/Groups.h"

namespace hybrid_slam::comparison {

/// What all runs of a comparison have in common.
struct CommonSetup {
  std::string config;                 ///< INI file; empty: none
  std::string log;                    ///< file or folder
  std::vector<std::string> settings;  ///< SECTION.KEY=VALUE, on top of the INI file
};

/// An INI file and the settings on top of it.
struct RunSetup {
  std::string config;  ///< empty: none
  std::vector<std::string> settings;

  /// @throws InputError for a wrong file or setting
  run::Configuration configuration() const { return run::Configuration(config, settings); }
};

/// The INI file is the variant's or else the common one. The settings are the common ones, the variant's, and
/// log, method, particles, seed and threads.
/// @throws InputError for the method `stock`, as `configuration`
RunSetup setupOf(const CommonSetup& common, const Group& group, int seed);

}  // namespace hybrid_slam::comparison
