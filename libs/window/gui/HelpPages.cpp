#include "window/gui/HelpPages.h"

#include <wx/utils.h>

#include "base/Errors.h"

namespace hybrid_slam::window {

const std::vector<HelpPage>& helpPages() {
  static const std::vector<HelpPage> pages{{"This &window\tF1", "doc/gui.md"},
                                           {"The &first map", "doc/first-map.md"},
                                           {"&Parameters", "doc/configuration.md"},
                                           {"&Results", "doc/results.md"},
                                           {"&Troubleshooting", "doc/troubleshooting.md"}};
  return pages;
}

void openPage(const std::string& page, const std::filesystem::path& bin) {
  const std::string file = files::withInstalledPages(page, bin);
  if (file == page)
    throw InputError("page not installed", page, "expected the package's documentation, or see the sources");
  if (!wxLaunchDefaultApplication(wxString::FromUTF8(file)))
    throw InputError("no program to show the page", file, "expected xdg-open (Debian: xdg-utils)");
}

}  // namespace hybrid_slam::window
