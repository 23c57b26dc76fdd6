#include "files/PartialFile.h"

#include <cstring>
#include <filesystem>

#include "base/Errors.h"

namespace hybrid_slam::files {

namespace fs = std::filesystem;

std::string PartialFile::partialName(const std::string& path) {
  return (fs::path(path).parent_path() / (".partial." + fs::path(path).filename().string())).string();
}

PartialFile::PartialFile(const std::string& path) : final_(path), partial_(partialName(path)) {
  std::error_code ignored;
  if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored))
    throw InputError("cannot write", path, "expected a file name");
}

PartialFile::~PartialFile() {
  std::error_code ignored;
  fs::remove(partial_, ignored);
}

void PartialFile::commit() {
  std::error_code error;
  fs::rename(partial_, final_, error);
  if (error) fail(error.value());
}

void PartialFile::fail(int error) const {
  throw InputError("cannot write", final_,
                   std::string("expected a writable folder with free disk space") +
                       (error ? std::string(": ") + std::strerror(error) : std::string()));
}

}  // namespace hybrid_slam::files
