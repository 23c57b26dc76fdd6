/// @file InstalledFiles.h
/// @brief The settings, data and pages that `cmake --install` puts beside the program.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>

namespace hybrid_slam::files {

/// The folder of the running program: PREFIX/bin once it is installed.
std::filesystem::path programFolder();

/// Finds a file that the user names, such as `config-ini/malaga.ini`, in the working folder or else in
/// PREFIX/share/hybrid_slam.
/// @return its path; the given name if it is in neither
std::string inputFile(const std::string& name, const std::filesystem::path& bin = programFolder());

/// Replaces each name as `inputFile` does.
void findInputFiles(std::initializer_list<std::string*> names,
                    const std::filesystem::path& bin = programFolder());

/// Replaces each `doc/PAGE.md` in a text with the path of the installed page. Leaves names of pages that are
/// not installed.
std::string withInstalledPages(std::string text, const std::filesystem::path& bin = programFolder());

}  // namespace hybrid_slam::files
