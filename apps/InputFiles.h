/// @file InputFiles.h
/// @brief The positional arguments `[config.ini] [log]`.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <system_error>

#include "base/Errors.h"
#include "files/IniFile.h"
#include "files/InstalledFiles.h"
#include "readings/LogFormats.h"

namespace hybrid_slam {

/// An INI file, a log, or both in this order. A single file is an INI file if its name or content says so.
/// Installed files are found too.
struct InputFiles {
  std::string config, log;  ///< empty: not given

  void add(CLI::App& app, const std::string& logMeans) {
    app.add_option("config", config, "INI file (doc/configuration.md); without one, the defaults apply");
    app.add_option("log", log, logMeans);
  }
  /// Assigns the files to `config` and `log`; call it after parsing. @throws InputError if the first of two
  /// is no INI file
  void sort() {
    files::findInputFiles({&config, &log});
    if (config.empty()) return;
    if (log.empty()) {
      if (!files::isIni(config)) log.swap(config);
      return;
    }
    std::error_code ignored;
    if (std::filesystem::is_regular_file(config, ignored) && !files::isIni(config))  // a pipe would be read
      throw InputError("not an INI file", config,
                       "of two files, the first is the INI file and the second the log");
  }
  /// The file that an error is about.
  const std::string& main() const { return config.empty() ? log : config; }
};

/// The log's formats, for --help.
inline std::string logMeans() { return "rawlog, " + readings::robotLogs(); }

}  // namespace hybrid_slam
