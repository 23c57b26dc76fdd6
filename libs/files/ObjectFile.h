/// @file ObjectFile.h
/// @brief A file of serialised objects, plain or compressed.
#pragma once

#include <string>

#include "files/CompressedFile.h"
#include "files/ObjectBytes.h"

namespace hybrid_slam::files {

/// An open file of objects.
class ObjectFile {
 public:
  /// @param expected  end of the error messages: "expected a readable log"
  /// @throws InputError if the file is missing, not a file, or not readable
  ObjectFile(const std::string& path, const std::string& expected);
  ObjectFile(const ObjectFile&) = delete;
  ObjectFile& operator=(const ObjectFile&) = delete;

  ObjectBytes& bytes() { return bytes_; }
  /// Returns "gzip file damaged or cut off" if the part read so far is; else empty. MRPT's own gzip stream
  /// cannot tell this from the end.
  std::string damage() const;

 private:
  CompressedFile file_;
  ObjectBytes bytes_;
};

}  // namespace hybrid_slam::files
