#include "files/InputFile.h"

#include <sys/stat.h>

#include <filesystem>
#include <set>
#include <sstream>

#include "base/Errors.h"

namespace hybrid_slam::files {

void expectFile(const std::string& path, const std::string& expected) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) throw InputError("no such file", path, expected);
  if (std::filesystem::is_directory(path, ignored)) throw InputError("a folder, not a file", path, expected);
  if (!std::filesystem::is_regular_file(path, ignored)) throw InputError("not a file", path, expected);
}

namespace {

/// Returns whether a file of a folder belongs to a recording of ROS 2, unlike results written there.
bool isOfRecording(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  return extension == ".db3" || extension == ".mcap" || extension == ".zstd" ||
         file.filename() == "metadata.yaml";
}

}  // namespace

void expectReplaceable(const std::string& path, const std::string& kind,
                       const std::function<bool(const std::string&)>& isOfKind) {
  std::error_code ignored;
  const bool hasContent =
      std::filesystem::is_regular_file(path, ignored) && std::filesystem::file_size(path, ignored) > 0;
  if (hasContent && !isOfKind(path))
    throw InputError("the output exists and is no " + kind, path,
                     "expected the name of a new file, or of a " + kind + " to replace");
}

std::string stateOf(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  std::set<std::string> files{path};
  if (fs::is_directory(path, ignored)) {
    files.clear();
    for (const auto& entry : fs::directory_iterator(path, ignored))
      if (isOfRecording(entry.path()) && entry.is_regular_file(ignored)) files.insert(entry.path().string());
  }
  std::ostringstream all;
  for (const std::string& file : files)
    if (struct stat status{}; ::stat(file.c_str(), &status) == 0)
      all << status.st_dev << ' ' << status.st_ino << ' ' << status.st_size << ' ' << status.st_mtim.tv_sec
          << ' ' << status.st_mtim.tv_nsec << ' ';
  return all.str();
}

}  // namespace hybrid_slam::files
