/// @file ObjectFile.h
/// @brief A file of serialised objects, plain or compressed.
#pragma once

#include <string>

#include "files/CompressedFile.h"
#include "files/ObjectBytes.h"

namespace hybrid_slam::files {

class ObjectFile {
 public:
  /// @param expected  end of the error messages: "expected a readable log"
  /// @throws InputError if the file is missing, not a file, or not readable
  ObjectFile(const std::string& path, const std::string& expected);
  ObjectFile(const ObjectFile&) = delete;
  ObjectFile& operator=(const ObjectFile&) = delete;

  ObjectBytes& bytes() { return bytes_; }
  /// "gzip file damaged or cut off", as far as it was read; else empty. MRPT's own gzip stream does not
  /// distinguish this from its end.
  std::string damage() const;

 private:
  CompressedFile file_;
  ObjectBytes bytes_;
};

}  // namespace hybrid_slam::files
