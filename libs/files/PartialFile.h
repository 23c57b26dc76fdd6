/// @file PartialFile.h
/// @brief A file that gets its name once it is complete.
#pragma once

#include <string>

namespace hybrid_slam::files {

/// Until `commit` the file is `.partial.NAME` in the folder of NAME; without `commit` it vanishes.
class PartialFile {
 public:
  /// @throws InputError if the name is that of a folder or a device, which must not be replaced
  explicit PartialFile(const std::string& path);
  ~PartialFile();
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  const std::string& path() const { return partial_; }  ///< where to write until then
  /// @throws InputError if the file cannot be given its name
  void commit();
  /// @param error  errno, or 0 where it is not known
  /// @throws InputError, which says that the file cannot be written
  [[noreturn]] void fail(int error) const;

 private:
  std::string final_, partial_;
};

}  // namespace hybrid_slam::files
