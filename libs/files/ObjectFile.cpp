#include "files/ObjectFile.h"

#include <zlib.h>

#include <filesystem>

#include "base/Errors.h"

namespace hybrid_slam::files {
namespace {

gzFile_s* openObjects(const std::string& path, const std::string& expected) {
  if (!std::filesystem::exists(path)) throw InputError("no such file", path, expected);
  if (!std::filesystem::is_regular_file(path)) throw InputError("not a file", path, expected);
  gzFile_s* const file = gzopen(path.c_str(), "rb");
  if (!file) throw InputError("cannot open", path, expected);
  return file;
}

}  // namespace

ObjectFile::ObjectFile(const std::string& path, const std::string& expected)
    : file_(openObjects(path, expected), gzclose_r),
      bytes_([this](char* to, size_t count) { return gzfread(to, 1, count, file_.get()); }) {}

bool ObjectFile::isDamaged() const {
  int error = Z_OK;
  gzerror(file_.get(), &error);
  return error != Z_OK;
}

}  // namespace hybrid_slam::files
