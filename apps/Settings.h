/// @file Settings.h
/// @brief What the command line says over the INI file: settings `SECTION.KEY=VALUE`.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace hybrid_slam {

/// Adds --set.
inline void addSettings(CLI::App& app, std::vector<std::string>& settings,
                        const std::string& purpose = "sets a key of the INI file; repeatable") {
  app.add_option("--set", settings, purpose)->type_name("SECTION.KEY=VALUE")->allow_extra_args(false);
}

/// One more setting, stronger than those before.
inline void set(std::vector<std::string>& settings, const std::string& key, const std::string& value) {
  settings.push_back(key + "=" + value);
}

}  // namespace hybrid_slam
