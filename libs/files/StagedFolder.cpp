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

#include "base/Errors.h"
#include "files/DatedName.h"
#include "files/Locks.h"

namespace hybrid_slam::files {

namespace fs = std::filesystem;

namespace {

int openFolder(const fs::path& folder) { return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); }

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
  if (error && !isUnknown)
    throw InputError("cannot write", path.string(),
                     std::string("expected a writable folder with free disk space: ") + std::strerror(error));
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
  final_ = fs::canonical(folder);
  if (isNew) created_.push_back(final_);
  const std::string prefix = "." + final_.filename().string() + ".part-";
  for (const std::string& name : results_)
    if (overwrite_ && fs::is_directory(final_ / name))
      throw InputError("cannot write", finalPath(name), "expected a file name");
  claim();
  isBeside_ = isRenamable(final_);
  stageIn(isBeside_ ? final_.parent_path() : final_, prefix);
  files_ = std::make_unique<OutputFolder>(stage_.string());
}

StagedFolder::~StagedFolder() {
  std::error_code ignored;
  if (!isDone_) fs::remove_all(stage_, ignored);
  for (const int lock : {claim_, lock_})
    if (lock >= 0) ::close(lock);
  std::reverse(created_.begin(), created_.end());
  for (const fs::path& folder : created_) fs::remove(folder, ignored);  // only if empty
}

std::string StagedFolder::note() const {
  if (shown_ == asked_) return {};
  if (isTaken_) return asked_ + " is in use by another run; the results of this one go to " + shown_;
  return asked_ + " has results of an earlier run; those of this run go to " + shown_ +
         " (--overwrite replaces them)";
}

bool StagedFolder::isResult(const std::string& name) const {
  return std::find(results_.begin(), results_.end(), name) != results_.end();
}

bool StagedFolder::holdsResults() const {
  return std::any_of(results_.begin(), results_.end(), [this](const std::string& name) {
    return name != own_ && fs::exists(fs::symlink_status(final_ / name));
  });
}

bool StagedFolder::isOfAnother(const std::string& name) const {
  std::error_code ignored;
  return name != own_ && fs::is_regular_file(final_ / name, ignored);
}

/// Locks the final folder, so that no other run writes its checkpoints there or replaces it.
void StagedFolder::claim() {
  for (;;) {
    claim_ = openFolder(final_);
    const Lock state = claim_ < 0 ? Lock::unsupported : lock(claim_);
    const bool isStale = claim_ >= 0 && !isNamed(claim_, final_);  // just replaced by the results of a run
    if (state != Lock::ofAnother && !isStale && (overwrite_ || !holdsResults())) return;
    if (claim_ >= 0) ::close(claim_);
    isTaken_ |= state == Lock::ofAnother;
    if (!isStale) takeDatedSubfolder();
  }
}

void StagedFolder::takeDatedSubfolder() {
  const fs::path folder = final_;
  const std::string name = claimDatedName([&](const std::string& date) {
    if (::mkdir((folder / date).c_str(), 0777) == 0) return true;
    if (errno == EEXIST) return false;
    throw InputError("output folder not writable", asked_,
                     std::string("expected a folder that can be written to: ") + std::strerror(errno));
  });
  final_ = folder / name;
  shown_ = (fs::path(asked_) / name).string();
  created_.push_back(final_);
}

/// Creates and locks the hidden folder. The lock distinguishes the folders of running programs from those of
/// killed ones.
void StagedFolder::stageIn(const fs::path& place, const std::string& prefix) {
  removeDead(place, prefix);
  for (;;) {
    std::string name = (place / (prefix + "XXXXXX")).string();
    if (!::mkdtemp(name.data()))
      throw InputError("output folder not writable", asked_,
                       std::string("expected a folder that can be written to: ") + std::strerror(errno));
    lock_ = openFolder(name);
    const bool isFree = lock_ < 0 || lock(lock_) != Lock::ofAnother;
    if (isFree && fs::exists(name)) {  // otherwise another process has just removed it as abandoned
      stage_ = name;
      fs::permissions(stage_, fs::status(final_).permissions());
      return;
    }
    if (lock_ >= 0) ::close(lock_);
  }
}

/// Removes the unfinished results of killed programs and no other file; other files in their folders are
/// links. Complete results that could not be renamed stay.
void StagedFolder::removeDead(const fs::path& place, const std::string& prefix) const {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(place, ignored)) {
    if (entry.path().filename().string().rfind(prefix, 0) != 0 || !entry.is_directory(ignored)) continue;
    const int folder = openFolder(entry.path());
    if (folder < 0) continue;
    if (lock(folder) == Lock::held && !fs::exists(entry.path() / results_.back(), ignored)) {
      for (const std::string& name : results_) {
        fs::remove(entry.path() / name, ignored);
        fs::remove(entry.path() / (".partial." + name), ignored);
      }
      for (const auto& other : fs::directory_iterator(entry.path(), ignored))  // links to files of the folder
        if (fs::equivalent(other.path(), final_ / other.path().filename(), ignored))
          fs::remove(other.path(), ignored);
      fs::remove(entry.path(), ignored);
    }
    ::close(folder);
  }
}

void StagedFolder::publish() {
  sync(stage_);
  if (!overwrite_ && holdsResults()) takeDatedSubfolder();  // copied there meanwhile
  isDone_ = true;
  if (isBeside_ && ::rename(stage_.c_str(), final_.c_str()) == 0) return;
  if (isBeside_ && exchange())
    returnOthers();
  else
    moveOneByOne();
}

/// Swaps both folders in one step. Links other files first, so that they are never missing.
bool StagedFolder::exchange() const {
  std::error_code isMovedLater;
  for (const auto& entry : fs::directory_iterator(final_))
    if (const std::string name = entry.path().filename().string(); !entry.is_directory() && !isResult(name))
      fs::create_hard_link(entry.path(), stage_ / name, isMovedLater);
  return ::renameat2(AT_FDCWD, stage_.c_str(), AT_FDCWD, final_.c_str(), RENAME_EXCHANGE) == 0;
}

/// After the exchange: moves what could not be linked, then removes the rest of the old folder.
void StagedFolder::returnOthers() const {
  std::error_code error;
  bool hasOthers = false;
  for (const auto& entry : fs::directory_iterator(stage_))
    if (const fs::path name = entry.path().filename();
        !isResult(name.string()) && !fs::exists(fs::symlink_status(final_ / name))) {
      fs::rename(entry.path(), final_ / name, error);
      hasOthers |= static_cast<bool>(error);
    }
  if (hasOthers) return;
  fs::remove(stage_ / results_.back(), error);  // first, so that removeDead ends what a kill interrupts
  fs::remove_all(stage_, error);
}

void StagedFolder::moveOneByOne() const {
  std::error_code error;
  const std::string& last = results_.back();
  fs::remove(final_ / last, error);
  for (const std::string& name : results_)
    if (!fs::exists(stage_ / name)) fs::remove(final_ / name, error);
  std::vector<fs::path> names;
  for (const auto& entry : fs::directory_iterator(stage_)) names.push_back(entry.path().filename());
  std::stable_partition(names.begin(), names.end(), [&last](const fs::path& name) { return name != last; });
  for (const fs::path& name : names) {
    fs::rename(stage_ / name, final_ / name, error);
    if (error)
      throw InputError("results cannot be renamed", shown_,
                       "they are in " + stage_.string() + ": " + error.message());
  }
  fs::remove_all(stage_, error);
}

}  // namespace hybrid_slam::files
