/// @file ObjectFile.h
/// @brief A file of serialised objects, plain or gzipped.
#pragma once

#include <memory>
#include <string>

#include "files/ObjectBytes.h"

struct gzFile_s;

namespace hybrid_slam::files {

class ObjectFile {
 public:
  /// @param expected  end of the error messages: "expected a readable log"
  /// @throws InputError if the file is missing, not a file, or not readable
  ObjectFile(const std::string& path, const std::string& expected);
  ObjectFile(const ObjectFile&) = delete;
  ObjectFile& operator=(const ObjectFile&) = delete;

  ObjectBytes& bytes() { return bytes_; }
  /// Whether the gzip file is damaged or cut off, as far as it was read: MRPT's own gzip stream does not
  /// distinguish this from its end.
  bool isDamaged() const;

 private:
  std::unique_ptr<gzFile_s, int (*)(gzFile_s*)> file_;
  ObjectBytes bytes_;
};

}  // namespace hybrid_slam::files
