/// @file PartialFile.h
/// @brief A file that gets its final name once complete.
#pragma once

#include <string>

#include "base/Errors.h"

namespace hybrid_slam::files {

/// The disk is full or fails: no wrong input. Programs exit with 1.
class DiskError : public InputError {
 public:
  using InputError::InputError;
};

/// Whether errno says that the disk is full or fails.
bool isOfDisk(int error);

/// @param error  errno, or 0 if unknown: of an earlier write
/// @throws DiskError for a full or failing disk, else InputError: the file cannot be written
[[noreturn]] void failToWrite(const std::string& path, int error);

/// Until `commit`, the file is called `.partial.NAME`, in the folder of NAME; without `commit` it is removed.
/// If that folder is moved meanwhile, the file moves with it.
/// If that name is taken, by another writer or by a file that a killed one has left, it is `.partial-2.NAME`,
/// and so on: what is left may be a recording.
class PartialFile {
 public:
  /// @throws InputError if the name is a folder or device, which must not be replaced, or cannot be written
  explicit PartialFile(const std::string& path);
  ~PartialFile();
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  /// The partial name of a file with one writer.
  static std::string partialName(const std::string& path);
  /// Removes the partial files of this name that killed writers have left.
  static void removeLeft(const std::string& path);

  const std::string& path() const { return partial_; }  ///< where to write until then
  const std::string& finalPath() const { return final_; }
  /// Syncs the file to disk and renames it, so that a power cut leaves no empty file under its name.
  /// @throws InputError if either fails, or if the file was removed or replaced
  void commit();
  /// Renames a file that cannot be written to its end. @throws InputError as `commit`
  void keep();
  /// @throws InputError as `failToWrite`
  [[noreturn]] void fail(int error) const { failToWrite(final_, error); }

 private:
  void claim();
  bool follow();

  std::string final_, partial_;
  int lock_ = -1;  ///< held while this object lives
};

}  // namespace hybrid_slam::files
