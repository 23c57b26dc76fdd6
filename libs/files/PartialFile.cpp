#include "files/PartialFile.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "base/Errors.h"
#include "files/Locks.h"

namespace hybrid_slam::files {

namespace fs = std::filesystem;

namespace {

std::string nameOf(const fs::path& path, const std::string& number) {
  return (path.parent_path() / (".partial" + number + "." + path.filename().string())).string();
}

/// Returns whether a name is `.partial.NAME` or `.partial-N.NAME`.
bool isPartial(const std::string& name, const std::string& final) {
  const std::string start = ".partial", end = "." + final;
  if (name.size() < start.size() + end.size() || name.rfind(start, 0) != 0 ||
      name.compare(name.size() - end.size(), end.size(), end) != 0)
    return false;
  const std::string number = name.substr(start.size(), name.size() - start.size() - end.size());
  return number.empty() || (number.size() > 1 && number.front() == '-' &&
                            number.find_first_not_of("0123456789", 1) == std::string::npos);
}

}  // namespace

std::string PartialFile::partialName(const std::string& path) { return nameOf(path, ""); }

PartialFile::PartialFile(const std::string& path) : final_(path) {
  std::error_code ignored;
  // Renaming would replace a link, such as a device's.
  if (fs::is_symlink(path, ignored) && fs::exists(path, ignored))
    final_ = fs::canonical(path, ignored).string();
  partial_ = partialName(final_);
  if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored))
    throw InputError("cannot write", path, "expected a file name");
  claim();
}

/// Files that have the name are those of other writers, or what killed ones have left, such as a recording:
/// they stay. The lock distinguishes them.
void PartialFile::claim() {
  for (int number = 1;;) {
    lock_ = ::open(partial_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (lock_ < 0 && errno != EEXIST) fail(errno);
    if (lock_ < 0) {
      partial_ = nameOf(final_, "-" + std::to_string(++number));
      continue;
    }
    lock(lock_);
    if (isNamed(lock_, partial_)) return;  // else `removeLeft` was faster
    ::close(lock_);
  }
}

void PartialFile::removeLeft(const std::string& path) {
  std::error_code ignored;
  const fs::path folder = fs::path(path).parent_path();
  for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, ignored)) {
    if (!isPartial(entry.path().filename().string(), fs::path(path).filename().string())) continue;
    const int file = ::open(entry.path().c_str(), O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) continue;
    if (lock(file) != Lock::ofAnother) fs::remove(entry.path(), ignored);
    ::close(file);
  }
}

/// Finds the file again if a folder above it was moved. Returns false if it was removed, or replaced.
bool PartialFile::follow() {
  if (isNamed(lock_, partial_)) return true;
  const fs::path moved = pathOf(lock_);
  if (moved.empty()) return false;
  final_ = (moved.parent_path() / fs::path(final_).filename()).string();
  partial_ = moved.string();
  return true;
}

PartialFile::~PartialFile() {
  std::error_code ignored;
  if (!partial_.empty() && follow()) fs::remove(partial_, ignored);
  if (lock_ >= 0) ::close(lock_);
}

void PartialFile::commit() {
  if (::fsync(lock_) != 0) fail(errno);
  keep();
}

void PartialFile::keep() {
  if (!follow())
    throw InputError("removed while it was written", final_, "expected that the output folder stays there");
  std::error_code error;
  fs::rename(partial_, final_, error);
  if (error) fail(error.value());
  partial_.clear();  // another writer may have that name now
}

bool isOfDisk(int error) { return error == ENOSPC || error == EDQUOT || error == EFBIG || error == EIO; }

void failToWrite(const std::string& path, int error) {
  const std::string expected = "expected a writable folder with free disk space" +
                               (error ? std::string(": ") + std::strerror(error) : std::string());
  if (error == 0 || isOfDisk(error)) throw DiskError("cannot write", path, expected);
  throw InputError("cannot write", path, expected);
}

}  // namespace hybrid_slam::files
