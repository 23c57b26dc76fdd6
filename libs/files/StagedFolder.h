/// @file StagedFolder.h
/// @brief Results that appear together or not at all.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "files/OutputFolder.h"

namespace hybrid_slam::files {

/// Files are written to a hidden folder `.NAME.part-XXXXXX` beside the folder NAME. `publish` renames it to
/// NAME; without `publish` it is removed. Other files in NAME stay. Where NAME cannot be renamed (a mount
/// point, the working directory), the hidden folder is in it, and the files are renamed one by one, the last
/// result last. Folders that are moved during the run are found again; links in their places are not
/// followed.
class StagedFolder {
 public:
  /// Chooses the final folder, and creates it empty: `folder`, or a dated subfolder if `folder` already has
  /// results and `overwrite` is false. If another object, in any process, has chosen it, or a subfolder that
  /// replacing it would move: a dated folder beside it.
  /// @param results  names of all files that a run may write; the last marks a complete run
  /// @param own        a result that may already exist, because the run continues from it
  /// @throws InputError if the folder cannot be created or written to, or is inside one in use
  StagedFolder(const std::string& folder, const std::vector<std::string>& results, bool overwrite,
               const std::string& own = {});
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  /// @throws InputError if the results would replace one of these files, which the run reads
  void expectKept(const std::vector<std::string>& inputs) const;
  /// Names a result that this run has just written to the final folder.
  void setOwn(const std::string& name);
  /// Puts the own result of the final folder among the new ones, which lack it. Returns its path there; empty
  /// if there is none.
  /// @throws InputError if that fails; the result stays in the final folder
  std::string keepOwn();
  /// Returns whether another run has written this file to the final folder, or has replaced ours.
  bool isOfAnother(const std::string& name) const;
  /// The hidden folder.
  const OutputFolder& files() const { return *files_; }
  /// The final folder as the user wrote it, or its dated subfolder.
  const std::string& folder() const { return shown_; }
  /// A file's path in the final folder, which may still change in `publish` if results have been copied
  /// there.
  std::string finalPath(const std::string& name) const { return shown_ + "/" + name; }
  /// Says in one line where the results go, if not to the requested folder; else empty.
  std::string note() const;

  /// Finds the folders again if they, or one above them, were moved, and creates removed ones again, empty.
  /// @throws InputError if that fails
  void follow();
  /// @throws InputError if the results cannot be written to disk, or cannot be renamed; they then stay in the
  ///         hidden folder, which it names
  void publish();

 private:
  bool hasFinal();
  bool hasStage();
  void createFinalAgain();
  void replaceFinal();
  [[noreturn]] void cannotRename(const std::string& reason) const;
  bool isOwn(const std::filesystem::path& folder, const std::string& name) const;
  bool holdsResults(const std::filesystem::path& folder) const;
  void release();
  void claim();
  void takeDatedSubfolder();
  void takeFolderBeside();
  void stageIn(const std::filesystem::path& place, const std::string& prefix);
  void removeDead(const std::filesystem::path& place) const;

  std::vector<std::string> results_;
  bool overwrite_;
  std::string own_;
  std::string asked_, shown_;    ///< as the user writes them
  std::filesystem::path final_;  ///< absolute, without symbolic links
  std::filesystem::path stage_;
  std::vector<std::filesystem::path> created_;  ///< removed again if they stay empty
  bool isBeside_ = false, isDone_ = false;
  bool hasLeft_ = false;    ///< files in the hidden folder
  bool isTaken_ = false;    ///< the requested folder, by another run
  bool isMoved_ = false;    ///< or removed
  std::string ownState_;    ///< stateOf the own result
  int folder_ = -1;         ///< the final folder, one of locks_
  std::vector<int> locks_;  ///< of the final folder, and of those above it
  int lock_ = -1;           ///< of the hidden folder, which becomes the final one
  std::unique_ptr<OutputFolder> files_;
};

}  // namespace hybrid_slam::files
