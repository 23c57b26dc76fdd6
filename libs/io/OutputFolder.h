/// @file OutputFolder.h
/// @brief Result files that are there whole or not at all.
#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

namespace hybrid_slam {

/// A folder of results. Every file is written beside its place and renamed when it is complete.
class OutputFolder {
 public:
  /// Makes the folder if it is missing.
  /// @throws InputError if it cannot be made or written to
  explicit OutputFolder(const std::string& folder);

  /// Writes a text file by `fill`.
  /// @throws std::runtime_error if it cannot be written whole (a full disk); nothing is left then
  void write(const std::string& name, const std::function<void(std::ostream&)>& fill) const;
  /// The same for a writer that takes a path and tells whether it succeeded. The path ends as the name does.
  void writeFile(const std::string& name, const std::function<bool(const std::string&)>& fill) const;

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

 private:
  std::filesystem::path folder_;
};

/// A text file that grows line by line during a run and gets its name at the end; without `finish` it
/// vanishes.
class GrowingFile {
 public:
  GrowingFile(const OutputFolder& folder, const std::string& name);
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  std::ostream& stream() { return out_; }
  /// @throws std::runtime_error if it could not be written whole
  void finish();

 private:
  std::string partial_, final_;
  std::ofstream out_;
};

}  // namespace hybrid_slam
