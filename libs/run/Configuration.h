/// @file Configuration.h
/// @brief Configuration of a run from an INI file, whose sections are checked.
#pragma once

#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/math/TPose2D.h>

#include <optional>
#include <string>
#include <vector>

#include "files/IniFile.h"
#include "readings/RawlogSource.h"
#include "slam/filter/FilterOptions.h"
#include "slam/ortho/OrthoOptions.h"

namespace hybrid_slam::run {

/// Section [run].
struct RunOptions : Options {
  enum class Method { hybrid, general, linemap, ortho, stock };

  Method method = Method::hybrid;
  std::string rawlog;
  std::string output = "out";
  int particlesEvery = 0;
  int refine = 1;
  int retryParticles = 60;

  /// @name Set on the command line only
  /// @{
  bool overwrite = false;                        ///< a configuration must not delete results
  std::string resume, continueFrom, localizeIn;  ///< session files (or maps); empty: a new run
  std::string priorPlan;                         ///< floor plan (PlanFiles.h) to begin with; empty: none
  std::optional<mrpt::math::TPose2D> start;      ///< in that map or plan (m, rad); empty: to be found
  double checkpointEvery = 0;                    ///< s of work between checkpoints; 0: none
  /// @}
  void describe(OptionTable& table) override;
};

/// Returns the method's name on the command line (`--method`), such as "hybrid".
std::string nameOf(RunOptions::Method method);

/// All settings of a replay. Other sections (MRPT's, a grabber's) are ignored.
struct Configuration {
  RunOptions run;
  readings::InputOptions input;
  FilterConfiguration filter;
  OrthoOptions ortho;
  std::string iniFile;  ///< empty: none
  /// The contents of the file as read, with the command-line settings; `stock` reads MRPT's sections from it.
  mrpt::config::CConfigFileMemory source;

  /// A line for each unknown section of the file.
  std::vector<std::string> warnings;

  /// @param file      the INI file; empty: none
  /// @param settings  `SECTION.KEY=VALUE` each; override the file
  /// @param more      further sections of the program; must outlive the configuration
  /// @throws InputError as loadIni and InputOptions::check; a file with only MRPT's RBPF section is accepted
  Configuration(const std::string& file, const std::vector<std::string>& settings,
                const files::Sections& more = {});
  Configuration() = default;
  /// Loads the `text()` of an earlier run. @param file  file that holds it, for errors
  void load(const std::string& text, const std::string& file);

  /// Returns a copy without the further sections of the program; it may outlive them.
  Configuration alone() const;
  files::Sections sections();
  /// Sets one of our keys unless the file or the command line does. @return whether it was set
  bool setDefault(const std::string& section, const std::string& key, const std::string& value);
  /// Chooses the method, and with it the kinds of maps that the particles hold.
  void setMethod(RunOptions::Method method);
  /// Returns all our keys with their values, and the file's other sections. Reading it back gives the same
  /// run.
  std::string text();

 private:
  files::Sections more_;
};

/// Returns every section and key with default, unit, range and meaning as Markdown: doc/configuration.md.
std::string configurationManual();
/// Returns the same manual as plain text for a terminal.
std::string plainConfigurationManual();

/// The main section of MRPT's rbpf-slam.
inline const char* const kStockSection = "MappingApplication";

}  // namespace hybrid_slam::run
