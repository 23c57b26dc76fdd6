/// @file Settings.h
/// @brief The window's INI settings: shared and immutable.
#pragma once

#include <memory>
#include <string>

#include "live/LiveOptions.h"
#include "run/Configuration.h"

namespace hybrid_slam::window {

/// A run's configuration with section [live]. Sessions in other threads keep the settings they started with.
struct Settings {
  live::LiveOptions live;
  run::Configuration configuration;

  /// @throws InputError as Configuration does
  static std::shared_ptr<Settings> fromFile(const std::string& file,
                                            const std::vector<std::string>& changes = {});
  /// A modified copy. @param changes  SECTION.KEY=VALUE each
  std::shared_ptr<Settings> copy(const std::vector<std::string>& changes = {}) const;

 private:
  Settings(const std::string& file, const std::vector<std::string>& changes)
      : configuration(file, changes, {{"live", &live}}) {}
};

}  // namespace hybrid_slam::window
