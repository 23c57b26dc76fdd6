#include "window/gui/HelpPages.h"

#include <wx/utils.h>

#include <system_error>

#include "base/Errors.h"

namespace hybrid_slam::window {
namespace {

namespace fs = std::filesystem;

/// Returns the installed page, or the one in the sources around the build or working folder; empty if neither
/// exists.
std::string fileOf(const std::string& page, const fs::path& bin) {
  if (const std::string installed = files::withInstalledPages(page, bin); installed != page) return installed;
  std::error_code ignored;
  for (fs::path folder : {bin, fs::current_path(ignored)})
    for (; folder.has_relative_path(); folder = folder.parent_path())
      if (fs::exists(folder / page, ignored)) return (folder / page).string();
  return {};
}

}  // namespace

const std::vector<HelpPage>& helpPages() {
  static const std::vector<HelpPage> pages{{"This &window\tF1", "doc/gui.md"},
                                           {"The &first map", "doc/first-map.md"},
                                           {"&Parameters", "doc/configuration.md"},
                                           {"&Results", "doc/results.md"},
                                           {"&Troubleshooting", "doc/troubleshooting.md"}};
  return pages;
}

void openPage(const std::string& page, const std::filesystem::path& bin) {
  const std::string file = fileOf(page, bin);
  if (file.empty())
    throw InputError("page not found", page, "expected the package's documentation, or the sources");
  if (!wxLaunchDefaultApplication(wxString::FromUTF8(file)))
    throw InputError("no program to show the page", file, "expected xdg-open (Debian: xdg-utils)");
}

}  // namespace hybrid_slam::window
