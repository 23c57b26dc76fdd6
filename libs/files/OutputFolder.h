/// @file OutputFolder.h
/// @brief Result files that are written completely or not at all.
#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "files/PartialFile.h"

namespace hybrid_slam::files {

/// A folder of results.
class OutputFolder {
 public:
  /// Creates the folder if missing.
  /// @throws InputError if it cannot be created or written to
  explicit OutputFolder(const std::string& folder);

  /// Lets `fill` write a file.
  /// @throws InputError if it cannot be written completely (full disk); no file is left then
  void write(const std::string& name, const std::function<void(std::ostream&)>& fill) const;

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

 private:
  std::filesystem::path folder_;
};

/// A file that gets its final name once it is complete; without `finish` it is removed.
class GrowingFile {
 public:
  /// @throws InputError if it cannot be opened
  explicit GrowingFile(const std::string& path);

  std::ostream& stream() { return out_; }
  /// @throws InputError if it could not be written completely
  void finish();

 private:
  PartialFile file_;
  std::ofstream out_;
};

}  // namespace hybrid_slam::files
