#include "files/StagedFolder.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <utility>

#include "base/Errors.h"
#include "files/DatedName.h"
#include "files/FolderReplacement.h"
#include "files/InputFile.h"
#include "files/Locks.h"
#include "files/PartialFile.h"

namespace hybrid_slam::files {

namespace fs = std::filesystem;

namespace {

std::string prefixOf(const fs::path& folder) { return "." + folder.filename().string() + ".part-"; }

int openFolder(const fs::path& folder) { return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); }

/// Returns where an open file or folder is, or its path if it is not open; empty if it was removed.
fs::path placeOf(int file, const fs::path& path) {
  return file < 0 || isNamed(file, path.string()) ? path : fs::path(pathOf(file));
}

/// Returns whether a folder can be renamed within its parent.
bool isRenamable(const fs::path& folder) {
  struct stat own {
  }, parent{};
  std::error_code ignored;
  return ::access(folder.parent_path().c_str(), W_OK) == 0 && ::stat(folder.c_str(), &own) == 0 &&
         ::stat(folder.parent_path().c_str(), &parent) == 0 && own.st_dev == parent.st_dev &&
         own.st_ino != parent.st_ino && !fs::equivalent(folder, fs::current_path(ignored), ignored);
}

/// Syncs a file or a folder's entries to disk.
/// @throws InputError if that fails
void syncOne(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const int error = file < 0 || ::fsync(file) != 0 ? errno : 0;
  if (file >= 0) ::close(file);
  const bool isUnknown = error == EINVAL && fs::is_directory(path);  // some file systems cannot sync folders
  if (error && !isUnknown) failToWrite(path.string(), error);
}

/// Syncs a folder to disk, with its subfolders, so that a power cut after the renaming leaves no empty files.
/// @throws InputError if a file cannot be synced
void sync(const fs::path& folder) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) syncOne(entry.path());
  syncOne(folder);
}

}  // namespace

StagedFolder::StagedFolder(const std::string& folder, const std::vector<std::string>& results, bool overwrite,
                           const std::string& own)
    : results_(results), overwrite_(overwrite), own_(own), asked_(folder), shown_(folder) {
  std::error_code ignored;
  const bool isNew = !fs::exists(folder, ignored);
  const OutputFolder probe(folder);
  if (::access(folder.c_str(), R_OK) != 0)
    throw InputError("output folder not readable", folder, "expected a folder whose files can be listed");
  final_ = fs::canonical(folder);
  if (isNew) created_.push_back(final_);
  if (!own.empty()) setOwn(own);
  const std::string prefix = prefixOf(final_);
  for (const std::string& name : results_)
    if (overwrite_ && fs::is_directory(final_ / name))
      throw InputError("cannot write", finalPath(name), "expected a file name");
  try {
    claim();
    isBeside_ = isRenamable(final_);
    stageIn(isBeside_ ? final_.parent_path() : final_, prefix);
    files_ = std::make_unique<OutputFolder>(stage_.string());
  } catch (...) {
    release();
    throw;
  }
}

StagedFolder::~StagedFolder() { release(); }

void StagedFolder::release() {
  std::error_code ignored;
  if (!isDone_ && !stage_.empty()) fs::remove_all(placeOf(lock_, stage_), ignored);
  for (fs::path& folder : created_)
    if (folder == final_) folder = placeOf(folder_, final_);
  locks_.push_back(lock_);
  for (const int lock : locks_)
    if (lock >= 0) ::close(lock);
  std::reverse(created_.begin(), created_.end());
  for (const fs::path& folder : created_) ::rmdir(folder.c_str());  // only if it is an empty folder
}

std::string StagedFolder::note() const {
  if (hasLeft_) return "files of " + shown_ + " that cannot be moved back are in " + stage_.string();
  if (isMoved_) return asked_ + " was moved or removed during the run; the results are in " + shown_;
  if (shown_ == asked_) return {};
  if (isTaken_) return asked_ + " is in use by another run; the results of this one go to " + shown_;
  return asked_ + " has results of an earlier run; those of this run go to " + shown_ +
         " (--overwrite replaces them)";
}

bool StagedFolder::isOwn(const fs::path& folder, const std::string& name) const {
  return name == own_ && stateOf((folder / name).string()) == ownState_;
}

bool StagedFolder::holdsResults(const fs::path& folder) const {
  return std::any_of(results_.begin(), results_.end(), [&](const std::string& name) {
    return !isOwn(folder, name) && fs::exists(fs::symlink_status(folder / name));
  });
}

void StagedFolder::expectKept(const std::vector<std::string>& inputs) const {
  if (!overwrite_) return;
  std::error_code ignored;
  for (const std::string& input : inputs)
    for (const std::string& name : results_)
      if (fs::equivalent(input, final_ / name, ignored))
        throw InputError("the results would replace an input", input, "expected another folder with -o");
}

void StagedFolder::setOwn(const std::string& name) {
  own_ = name;
  ownState_ = stateOf((final_ / own_).string());
}

std::string StagedFolder::keepOwn() {
  if (own_.empty() || !isOwn(final_, own_)) return {};
  const fs::path own = final_ / own_, kept = stage_ / own_;
  std::error_code error;
  fs::create_hard_link(own, kept, error);  // takes no space
  if (error && !fs::copy_file(own, kept, error)) {
    std::error_code ignored;
    fs::remove(kept, ignored);  // a part of it
    failToWrite(kept.string(), error.value());
  }
  return finalPath(own_);
}

bool StagedFolder::isOfAnother(const std::string& name) const {
  std::error_code ignored;
  return !isOwn(final_, name) && fs::is_regular_file(final_ / name, ignored);
}

/// Chooses the final folder and locks it, so that no other run writes its checkpoints there or replaces it. A
/// run in a subfolder of results shares the lock of the folder above, which nobody may replace meanwhile.
void StagedFolder::claim() {
  for (;;) {
    const int folder = openFolder(final_);
    const bool isOwn = overwrite_ || !holdsResults(final_);
    const Lock state = folder < 0 ? Lock::unsupported : isOwn ? lock(folder) : lockShared(folder);
    const bool isStale = folder >= 0 && !isNamed(folder, final_);  // just replaced by the results of a run
    if (state != Lock::ofAnother && !isStale && isOwn == (overwrite_ || !holdsResults(final_))) {
      locks_.push_back(folder_ = folder);
      if (locks_.size() == 1)
        for (const fs::path& place : {final_.parent_path(), final_}) removeDead(place);
      if (!isOwn) {
        takeDatedSubfolder();
        continue;
      }
      const fs::path above = final_.parent_path();
      locks_.push_back(openFolder(above));
      if (locks_.back() >= 0 && lockShared(locks_.back()) == Lock::ofAnother && isRenamable(above))
        throw InputError("the folder above is in use by another run", finalPath(""),
                         "expected an output folder that is not in the other's");
      return;
    }
    if (folder >= 0) ::close(folder);
    if (state != Lock::ofAnother) continue;
    isTaken_ = true;
    if (isRenamable(final_))
      takeFolderBeside();
    else
      takeDatedSubfolder();  // which stays where it is
  }
}

/// Takes DIR-DATE: a subfolder would move when the other run puts its results in place of DIR.
void StagedFolder::takeFolderBeside() {
  std::error_code ignored;
  const fs::path asked = fs::absolute(shown_, ignored);
  const std::string shown = asked == final_ ? shown_ : final_.string();
  const std::string date = claimDatedName([this](const std::string& name) {
    if (::mkdir((final_.string() + "-" + name).c_str(), 0777) == 0) return true;
    if (errno == EEXIST) return false;
    if (isOfDisk(errno)) failToWrite(asked_, errno);
    throw InputError(
        "output folder in use by another run", asked_,
        std::string("expected another folder, since none can be created beside it: ") + std::strerror(errno));
  });
  final_ += "-" + date;
  shown_ = shown + "-" + date;
  created_.push_back(final_);
}

void StagedFolder::takeDatedSubfolder() {
  const fs::path folder = final_;
  const std::string name = claimDatedName([&](const std::string& date) {
    if (::mkdir((folder / date).c_str(), 0777) == 0) return true;
    if (errno == EEXIST) return false;
    failToWrite(asked_, errno);
  });
  final_ = folder / name;
  shown_ = (fs::path(asked_) / name).string();
  created_.push_back(final_);
}

/// Creates and locks the hidden folder. The lock distinguishes the folders of running programs from those of
/// killed ones.
void StagedFolder::stageIn(const fs::path& place, const std::string& prefix) {
  for (;;) {
    std::string name = (place / (prefix + "XXXXXX")).string();
    if (!::mkdtemp(name.data())) failToWrite(asked_, errno);
    lock_ = openFolder(name);
    const bool isFree = lock_ < 0 || lock(lock_) != Lock::ofAnother;
    if (isFree && fs::exists(name)) {  // otherwise another process has just removed it as abandoned
      stage_ = name;
      if (fs::exists(final_)) fs::permissions(stage_, fs::status(final_).permissions());
      return;
    }
    if (lock_ >= 0) ::close(lock_);
  }
}

/// Removes the unfinished results of killed programs and no other file; other files in their folders are
/// links. Complete results that could not be renamed stay.
void StagedFolder::removeDead(const fs::path& place) const {
  const std::string prefix = prefixOf(final_);
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(place, ignored)) {
    if (entry.path().filename().string().rfind(prefix, 0) != 0 || !entry.is_directory(ignored)) continue;
    const int folder = openFolder(entry.path());
    if (folder < 0) continue;
    const bool isDead = lock(folder) == Lock::held;
    const FolderReplacement replacement(entry.path(), final_, results_);
    if (isDead) replacement.returnLinked();  // it was killed amid its exchange
    if (isDead && !fs::exists(entry.path() / results_.back(), ignored)) replacement.removeHidden();
    ::close(folder);
  }
}

/// Returns whether the final folder exists, here or where it was moved.
bool StagedFolder::hasFinal() {
  const fs::path before = final_;
  final_ = placeOf(folder_, final_);
  if (final_ == before) return true;
  isMoved_ = true;
  if (final_.empty()) {
    final_ = before;
    return false;
  }
  std::replace(created_.begin(), created_.end(), before, final_);
  shown_ = final_.string();
  return true;
}

/// The same for the hidden folder.
bool StagedFolder::hasStage() {
  const fs::path place = placeOf(lock_, stage_);
  if (place.empty()) return false;
  if (place != stage_) *files_ = OutputFolder((stage_ = place).string());
  return true;
}

/// Another folder, or a link, may have its name now.
void StagedFolder::createFinalAgain() {
  const OutputFolder above(final_.parent_path().string());
  if (::mkdir(final_.c_str(), 0777) == 0)
    created_.push_back(final_);
  else
    takeFolderBeside();
  folder_ = openFolder(final_);
  locks_.push_back(folder_);
  if (folder_ >= 0) lock(folder_);
}

void StagedFolder::follow() {
  if (!hasFinal()) createFinalAgain();
  if (hasStage()) return;
  if (lock_ >= 0) ::close(lock_);
  stageIn(isBeside_ ? final_.parent_path() : final_, prefixOf(final_));
  *files_ = OutputFolder(stage_.string());
}

void StagedFolder::publish() {
  if (!hasStage())
    throw InputError("results removed", stage_.string(), "expected that they stay until the run ends");
  sync(stage_);
  isDone_ = true;  // from here on, an error no longer removes the results
  try {
    if (!hasFinal()) createFinalAgain();
    replaceFinal();
  } catch (const fs::filesystem_error& error) {
    cannotRename(error.code().message());
  } catch (const std::exception& error) {
    cannotRename(messageOf(error));
  }
}

void StagedFolder::cannotRename(const std::string& reason) const {
  throw InputError("results cannot be renamed", shown_, "they are in " + stage_.string() + ": " + reason);
}

void StagedFolder::replaceFinal() {
  if (!overwrite_ && holdsResults(final_)) takeDatedSubfolder();  // copied there meanwhile
  for (const std::string& name : results_) PartialFile::removeLeft((final_ / name).string());
  if (isBeside_ && ::rename(stage_.c_str(), final_.c_str()) == 0) return;
  const FolderReplacement replacement(stage_, final_, results_);
  if (isBeside_ && replacement.exchange())
    hasLeft_ = !replacement.removeHidden();
  else
    replacement.moveOneByOne();
}

}  // namespace hybrid_slam::files
