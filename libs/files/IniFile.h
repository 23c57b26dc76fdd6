/// @file IniFile.h
/// @brief INI files: read, checked, loaded into options, documented.
#pragma once

#include <mrpt/config/CConfigFileMemory.h>

#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "base/Options.h"

namespace hybrid_slam::files {

/// (name, options) of each section of ours.
using Sections = std::vector<std::pair<std::string, Options*>>;

/// Reads a file and the command line's settings into `source`, and from there into the sections.
/// @param settings   `SECTION.KEY=VALUE` each, stronger than the file
/// @param otherwise  a section that will do where the file has none of ours; empty: none
/// @param expected   what to tell the user who gives a file without any of these
/// @throws InputError for a missing file, a file without any section of ours, a section that is ours but for
/// a
///         slip of the pen, a line that is none, a setting of a section that is neither ours nor in the file,
///         and for all that Options::loadFromConfigFile finds
void loadIni(mrpt::config::CConfigFileMemory& source, const std::string& file,
             const std::vector<std::string>& settings, const Sections& sections, const std::string& otherwise,
             const std::string& expected);

/// Every key with its default, unit, range and reason: a Markdown table for each section.
void writeManual(const Sections& sections, std::ostream& out);

}  // namespace hybrid_slam::files
