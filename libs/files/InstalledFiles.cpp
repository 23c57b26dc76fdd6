#include "files/InstalledFiles.h"

#include <system_error>

namespace hybrid_slam::files {
namespace {

namespace fs = std::filesystem;

const std::string kLower = "abcdefghijklmnopqrstuvwxyz0123456789-";
const std::string kOfPaths = kLower + "ABCDEFGHIJKLMNOPQRSTUVWXYZ_./";

bool isThere(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

}  // namespace

fs::path programFolder() {
  std::error_code ignored;
  return fs::read_symlink("/proc/self/exe", ignored).parent_path();
}

std::string inputFile(const std::string& name, const fs::path& bin) {
  if (name.empty() || fs::path(name).is_absolute() || isThere(name)) return name;
  const fs::path installed = bin.parent_path() / HYBRID_SLAM_DATA / name;
  return isThere(installed) ? installed.string() : name;
}

void findInputFiles(std::initializer_list<std::string*> names, const fs::path& bin) {
  for (std::string* const name : names) *name = inputFile(*name, bin);
}

std::string withInstalledPages(std::string text, const fs::path& bin) {
  const fs::path folder = bin.parent_path() / HYBRID_SLAM_PAGES;
  // No std::regex: it may overflow the stack on a long word, and messages quote what others wrote.
  for (size_t at = 0; (at = text.find("doc/", at)) != std::string::npos;) {
    const size_t name = at + 4, end = text.find_first_not_of(kLower, name);
    const bool begins = at == 0 || kOfPaths.find(text[at - 1]) == std::string::npos;
    std::string page;
    if (begins && end != std::string::npos && end - name < 100 && text.compare(end, 3, ".md") == 0)
      page = (folder / text.substr(at, end + 3 - at)).string();
    if (!page.empty() && isThere(page))
      text.replace(at, end + 3 - at, page), at += page.size();
    else
      at = name;
  }
  return text;
}

}  // namespace hybrid_slam::files
