/// @file FolderReplacement.h
/// @brief Replaces the results in a folder, and nothing else in it.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace hybrid_slam::files {

/// Puts the results in a hidden folder in place of those in the final folder. The other files and folders
/// stay in the final folder.
class FolderReplacement {
 public:
  /// @param results  names of all files that a run may write; the last marks a complete run
  FolderReplacement(std::filesystem::path hidden, std::filesystem::path final,
                    const std::vector<std::string>& results)
      : hidden_(std::move(hidden)), final_(std::move(final)), results_(results) {}

  /// Swaps both folders in one step, if the hidden one is beside the final one. The earlier results are then
  /// in the hidden folder.
  /// @return false, with nothing changed, if the file system cannot do that, or if a folder in the final one
  ///         cannot be moved
  bool exchange() const;
  /// Ends the exchange of a killed program: moves the other folders back in place of the links to them.
  void returnLinked() const;
  /// Removes results and links from the hidden folder, and the folder if nothing else is in it.
  /// @return whether the folder is gone
  bool removeHidden() const;
  /// Renames file after file, and removes the hidden folder. The result that marks a complete run comes last.
  /// @throws std::filesystem::filesystem_error if a file cannot be renamed; the others stay in the hidden
  /// folder
  void moveOneByOne() const;

 private:
  bool isResult(const std::string& name) const;
  void returnOthers() const;

  std::filesystem::path hidden_, final_;
  const std::vector<std::string>& results_;
};

}  // namespace hybrid_slam::files
