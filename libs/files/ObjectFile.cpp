#include "files/ObjectFile.h"

namespace hybrid_slam::files {

ObjectFile::ObjectFile(const std::string& path, const std::string& expected)
    : file_(path, expected), bytes_([this](char* to, size_t count) { return file_.read(to, count); }) {}

std::string ObjectFile::damage() const {
  if (file_.defect().empty()) return {};
  return file_.compression() ? std::string(nameOf(*file_.compression())) + " file damaged or cut off"
                             : file_.defect();
}

}  // namespace hybrid_slam::files
