/// @file Settings.h
/// @brief The INI file that the window works with: shared, and replaced rather than changed.
#pragma once

#include <memory>
#include <string>

#include "live/LiveOptions.h"
#include "run/Configuration.h"

namespace hybrid_slam::window {

/// A run's configuration with section [live]. Sessions in other threads keep what they were started with.
struct Settings {
  live::LiveOptions live;
  run::Configuration configuration;

  /// @throws InputError as Configuration does
  static std::shared_ptr<Settings> fromFile(const std::string& file,
                                            const std::vector<std::string>& changes = {});
  /// The same settings, to be changed. @param changes  SECTION.KEY=VALUE each
  std::shared_ptr<Settings> copy(const std::vector<std::string>& changes = {}) const;

 private:
  Settings(const std::string& file, const std::vector<std::string>& changes)
      : configuration(file, changes, {{"live", &live}}) {}
};

}  // namespace hybrid_slam::window
