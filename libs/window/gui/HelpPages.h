/// @file HelpPages.h
/// @brief The pages of the documentation in the Help menu.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "files/InstalledFiles.h"

namespace hybrid_slam::window {

/// A page and its entry in the menu.
struct HelpPage {
  const char* entry;  ///< of the menu, with its key
  const char* page;
};

/// Returns the pages in the order of the commands from kFirstPage on.
const std::vector<HelpPage>& helpPages();

/// Opens the installed page, or else the one in the sources, with the desktop's program for such files.
/// @param bin  folder of the program
/// @throws InputError if the page is in neither, or no program can show it
void openPage(const std::string& page, const std::filesystem::path& bin = files::programFolder());

}  // namespace hybrid_slam::window
