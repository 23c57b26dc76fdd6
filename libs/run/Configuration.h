/// @file Configuration.h
/// @brief The INI file of a run: every section of ours, checked.
#pragma once

#include <mrpt/config/CConfigFileMemory.h>

#include <string>
#include <vector>

#include "files/IniFile.h"
#include "readings/RawlogSource.h"
#include "slam/filter/FilterOptions.h"

namespace hybrid_slam::run {

/// Section [run].
struct RunOptions : Options {
  enum class Method { hybrid, general, stock };

  Method method = Method::hybrid;
  std::string rawlog;
  std::string output = "out";
  int particlesEvery = 0;
  int refine = 0;
  void describe(OptionTable& table) override;
};

/// All settings of a replay. Sections that are none of ours (MRPT's own, a grabber's) are left alone.
struct Configuration {
  RunOptions run;
  readings::InputOptions input;
  FilterConfiguration filter;
  /// The file as it was read, with the settings of the command line; `stock` reads MRPT's sections from it.
  mrpt::config::CConfigFileMemory source;

  /// @param file      the INI file
  /// @param settings  `SECTION.KEY=VALUE` each, stronger than the file
  /// @param more      further sections of the program, loaded with these; they outlive the configuration
  /// @throws InputError as loadIni does; MRPT's RBPF's section will do for one of ours
  Configuration(const std::string& file, const std::vector<std::string>& settings,
                const files::Sections& more = {});
  Configuration() = default;

  files::Sections sections();
  /// Every key of ours with its value, and the file's other sections: read back, the same run.
  std::string text();

 private:
  files::Sections more_;
};

/// Every section and key with its default, unit, range and reason, as Markdown: doc/configuration.md.
std::string configurationManual();

/// The section that MRPT's rbpf-slam starts from.
inline const char* const kStockSection = "MappingApplication";

}  // namespace hybrid_slam::run
