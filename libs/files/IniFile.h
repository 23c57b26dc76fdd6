/// @file IniFile.h
/// @brief Reads, checks and documents INI files.
#pragma once

#include <mrpt/config/CConfigFileMemory.h>

#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "base/Options.h"

namespace hybrid_slam::files {

/// (name, options) of each of our sections.
using Sections = std::vector<std::pair<std::string, Options*>>;

/// Reads a file and the command-line settings into `source`, and from there into the sections.
/// @param file       empty: none, the settings alone
/// @param settings   `SECTION.KEY=VALUE` each; override the file
/// @param otherwise  a section that suffices if the file has none of ours; empty: none
/// @param expected   end of the error for a file without any of these
/// @return a line for each section that neither we nor, as far as known, MRPT's programs use, and for each
///         key that a section has twice
/// @throws InputError for a missing file, a file without any of our sections, a misspelt section, a malformed
///         or overlong line, $eval{...} or $env{...}, a setting of a section neither ours nor in the file,
///         and as Options::loadFromConfigFile
std::vector<std::string> loadIni(mrpt::config::CConfigFileMemory& source, const std::string& file,
                                 const std::vector<std::string>& settings, const Sections& sections,
                                 const std::string& otherwise, const std::string& expected);

/// Loads the text of an INI file, as MRPT's parser returns it, in the same way as loadIni.
std::vector<std::string> loadIniText(mrpt::config::CConfigFileMemory& source, const std::string& text,
                                     const std::string& file, const std::vector<std::string>& settings,
                                     const Sections& sections, const std::string& otherwise,
                                     const std::string& expected);

/// Returns whether a file is an INI file rather than a log: its name ends in .ini, or its first line other
/// than blanks and comments is a section header.
bool isIni(const std::string& path);

/// Writes every key with default, unit, range and meaning, as a Markdown table per section.
void writeManual(const Sections& sections, std::ostream& out);

/// Writes the manual for a terminal: keys and defaults as in an INI file, meanings in lines of at most 80
/// characters.
void writePlainManual(const Sections& sections, std::ostream& out);

}  // namespace hybrid_slam::files
