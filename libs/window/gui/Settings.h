/// @file Settings.h
/// @brief The window's INI settings: shared and immutable.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <memory>
#include <optional>
#include <string>

#include "live/LiveOptions.h"
#include "run/LogSettings.h"

namespace hybrid_slam::window {

/// The map in which a run continues or localises, or the floor plan that it begins with.
struct MapChoice {
  enum class Use { none, mapOn, localise, plan };
  Use use = Use::none;
  std::string file;                          ///< session, map.yaml or gridmap; floor plan
  std::optional<mrpt::math::TPose2D> start;  ///< in this map or plan (m, rad); empty: searched for

  static MapChoice of(const run::RunOptions& run);
  bool operator==(const MapChoice& other) const {
    return use == other.use && file == other.file && start == other.start;
  }
};

/// A run's configuration with section [live]. Sessions in other threads keep the settings they started with.
struct Settings {
  live::LiveOptions live;
  run::Configuration configuration;

  /// Loads the settings of an INI file, without reading its log, which takes time (see withLog).
  /// @param file  empty: the defaults
  /// @throws InputError as Configuration does
  static std::shared_ptr<Settings> fromFile(const std::string& file,
                                            const std::vector<std::string>& changes = {});
  /// Returns a modified copy. It keeps the settings that follow from the log unless it names another log.
  /// @param changes  SECTION.KEY=VALUE each
  /// @param resets  SECTION.KEY each, which are reset to their defaults or to what follows from the log
  std::shared_ptr<Settings> copy(const std::vector<std::string>& changes = {},
                                 const std::vector<std::string>& resets = {}) const;
  /// Returns the settings with only the log set.
  std::shared_ptr<Settings> defaults() const;
  /// Returns a copy for runs in another map, or in a new one.
  std::shared_ptr<Settings> inMap(const MapChoice& map) const;
  /// Returns a copy in which these settings apply where the user has not set them. @param log  null: none
  std::shared_ptr<Settings> withLog(const std::shared_ptr<const run::LogSettings>& log) const;
  MapChoice map() const { return MapChoice::of(configuration.run); }

 private:
  Settings(const std::string& file, const std::vector<std::string>& changes, const Settings* before);

  void follow(const std::shared_ptr<const run::LogSettings>& log);

  /// Read off the log; null without one, and until it has been read.
  std::shared_ptr<const run::LogSettings> ofLog_;
};

}  // namespace hybrid_slam::window
