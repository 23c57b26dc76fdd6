#include "files/InputFile.h"

#include <filesystem>

#include "base/Errors.h"

namespace hybrid_slam::files {

void expectFile(const std::string& path, const std::string& expected) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) throw InputError("no such file", path, expected);
  if (std::filesystem::is_directory(path, ignored)) throw InputError("a folder, not a file", path, expected);
  if (!std::filesystem::is_regular_file(path, ignored)) throw InputError("not a file", path, expected);
}

}  // namespace hybrid_slam::files
