/// @file InstalledFiles.h
/// @brief The settings, data and pages that `cmake --install` puts beside the program.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>

namespace hybrid_slam::files {

/// The folder of the running program: PREFIX/bin once it is installed.
std::filesystem::path programFolder();

/// A file the user names, such as `config-ini/malaga.ini`. One that is not in the working folder is looked
/// for in PREFIX/share/hybrid_slam.
/// @return the name as given if it is found in neither
std::string inputFile(const std::string& name, const std::filesystem::path& bin = programFolder());

/// Replaces each name as `inputFile` does.
void findInputFiles(std::initializer_list<std::string*> names,
                    const std::filesystem::path& bin = programFolder());

/// A text with each `doc/PAGE.md` replaced by the path of the installed page. Unchanged where none is
/// installed.
std::string withInstalledPages(std::string text, const std::filesystem::path& bin = programFolder());

}  // namespace hybrid_slam::files
