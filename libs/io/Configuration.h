/// @file Configuration.h
/// @brief The INI file of a run: every section of ours, checked.
#pragma once

#include <mrpt/config/CConfigFileMemory.h>

#include <string>
#include <utility>
#include <vector>

#include "io/RawlogSource.h"
#include "rbpf/FilterOptions.h"

namespace hybrid_slam {

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
  InputOptions input;
  FilterConfiguration filter;
  /// The file as it was read, with the settings of the command line; `stock` reads MRPT's sections from it.
  mrpt::config::CConfigFileMemory source;

  /// @param file      the INI file
  /// @param settings  `SECTION.KEY=VALUE` each, stronger than the file
  /// @throws InputError for a missing file, a file without any section of ours (nor MRPT's RBPF's), a section
  ///         that is ours but for a slip of the pen, a line that is none, a setting of a section that is
  ///         neither ours nor in the file, and for all that Options::loadFromConfigFile finds
  Configuration(const std::string& file, const std::vector<std::string>& settings);
  Configuration() = default;

  std::vector<std::pair<std::string, Options*>> sections();
  /// Every key of ours with its value, and the file's other sections: read back, the same run.
  std::string text();

 private:
  void load(const std::string& where);  ///< from `source`; `where` it is from, for errors
};

/// Every section and key with its default, unit, range and reason, as Markdown: doc/configuration.md.
std::string configurationManual();

/// The section that MRPT's rbpf-slam starts from.
inline const char* const kStockSection = "MappingApplication";

}  // namespace hybrid_slam
