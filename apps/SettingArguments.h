/// @file SettingArguments.h
/// @brief Command-line option for settings `SECTION.KEY=VALUE` that override the INI file.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace hybrid_slam {

/// Adds --set.
inline void addSettings(CLI::App& app, std::vector<std::string>& settings,
                        const std::string& purpose = "override a key of the INI file; repeatable") {
  app.add_option("--set", settings, purpose)->type_name("SECTION.KEY=VALUE")->allow_extra_args(false);
}

/// Appends a setting, which overrides earlier ones.
inline void set(std::vector<std::string>& settings, const std::string& key, const std::string& value) {
  settings.push_back(key + "=" + value);
}

}  // namespace hybrid_slam
