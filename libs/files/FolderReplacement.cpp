#include "files/FolderReplacement.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "files/PartialFile.h"

namespace hybrid_slam::files {

namespace fs = std::filesystem;

namespace {

/// Returns whether an entry is a folder, not a link to one.
bool isFolder(const fs::directory_entry& entry) { return fs::is_directory(entry.symlink_status()); }

/// Returns whether two names are of one file, or of one symbolic link.
bool isSame(const fs::path& one, const fs::path& other) {
  struct stat first {
  }, second{};
  return ::lstat(one.c_str(), &first) == 0 && ::lstat(other.c_str(), &second) == 0 &&
         first.st_dev == second.st_dev && first.st_ino == second.st_ino;
}

/// Returns whether a folder can be moved to another one: it is writable, and no mount point.
bool isMovable(const fs::directory_entry& folder) {
  struct stat own {
  }, parent{};
  return ::access(folder.path().c_str(), W_OK) == 0 && ::stat(folder.path().c_str(), &own) == 0 &&
         ::stat(folder.path().parent_path().c_str(), &parent) == 0 && own.st_dev == parent.st_dev;
}

/// Renames a file or folder with the flags of renameat2. Returns false if that fails.
bool renameAs(const fs::path& from, const fs::path& to, unsigned flags) {
  return ::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), flags) == 0;
}

/// What a link in the final folder to a folder in a hidden one beside it contains.
fs::path linkTo(const fs::path& folder) { return ".." / folder.parent_path().filename() / folder.filename(); }

}  // namespace

bool FolderReplacement::isResult(const std::string& name) const {
  return std::find(results_.begin(), results_.end(), name) != results_.end();
}

/// First links the other files and folders, so that they are never missing, also if the program is killed.
bool FolderReplacement::exchange() const {
  for (const auto& entry : fs::directory_iterator(final_))
    if (isFolder(entry) && !isMovable(entry)) return false;
  std::error_code isMovedLater;
  for (const auto& entry : fs::directory_iterator(final_)) {
    const fs::path name = entry.path().filename();
    if (isResult(name.string())) continue;
    if (isFolder(entry))
      fs::create_directory_symlink(linkTo(hidden_ / name), hidden_ / name, isMovedLater);
    else
      fs::create_hard_link(entry.path(), hidden_ / name, isMovedLater);
  }
  if (!renameAs(hidden_, final_, RENAME_EXCHANGE)) return false;
  returnLinked();
  returnOthers();
  return true;
}

void FolderReplacement::returnLinked() const {
  std::error_code isNoLink;
  for (const auto& entry : fs::directory_iterator(hidden_))
    if (const fs::path there = final_ / entry.path().filename();
        isFolder(entry) && fs::read_symlink(there, isNoLink) == linkTo(entry.path()))
      renameAs(entry.path(), there, RENAME_EXCHANGE);
}

/// Moves what could not be linked.
void FolderReplacement::returnOthers() const {
  for (const auto& entry : fs::directory_iterator(hidden_)) {
    const fs::path name = entry.path().filename();
    if (!isResult(name.string()) && !fs::exists(fs::symlink_status(final_ / name)))
      renameAs(entry.path(), final_ / name, RENAME_NOREPLACE);
  }
}

bool FolderReplacement::removeHidden() const {
  std::error_code ignored;
  fs::remove(hidden_ / results_.back(), ignored);  // first, so that the next run ends what a kill interrupts
  for (const std::string& name : results_) {
    fs::remove(hidden_ / name, ignored);
    PartialFile::removeLeft((hidden_ / name).string());
  }
  for (const auto& other : fs::directory_iterator(hidden_, ignored))
    if (fs::read_symlink(other.path(), ignored) == linkTo(other.path()) ||
        (!isFolder(other) && isSame(other.path(), final_ / other.path().filename())))
      fs::remove(other.path(), ignored);
  return fs::remove(hidden_, ignored);
}

void FolderReplacement::moveOneByOne() const {
  std::error_code error;
  const std::string& last = results_.back();
  fs::remove(final_ / last, error);
  for (const std::string& name : results_)
    if (!fs::exists(hidden_ / name)) fs::remove(final_ / name, error);
  std::vector<fs::path> names;
  for (const auto& entry : fs::directory_iterator(hidden_))  // without the links of an exchange that failed
    if (fs::read_symlink(entry.path(), error) != linkTo(entry.path()))
      names.push_back(entry.path().filename());
  std::stable_partition(names.begin(), names.end(), [&last](const fs::path& name) { return name != last; });
  for (const fs::path& name : names) fs::rename(hidden_ / name, final_ / name);
  fs::remove_all(hidden_, error);
}

}  // namespace hybrid_slam::files
