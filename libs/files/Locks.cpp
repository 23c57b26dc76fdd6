#include "files/Locks.h"

#include <sys/file.h>
#include <sys/stat.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

namespace hybrid_slam::files {

namespace {

Lock lockAs(int file, int kind) {
  if (::flock(file, kind | LOCK_NB) == 0) return Lock::held;
  return errno == EWOULDBLOCK ? Lock::ofAnother : Lock::unsupported;
}

}  // namespace

Lock lock(int file) { return lockAs(file, LOCK_EX); }

Lock lockShared(int file) { return lockAs(file, LOCK_SH); }

bool isNamed(int file, const std::string& path) {
  struct stat opened {
  }, named{};
  return ::fstat(file, &opened) == 0 && ::lstat(path.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
         opened.st_ino == named.st_ino;
}

std::string pathOf(int file) {
  std::error_code unknown;
  const std::string path = std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(file), unknown);
  return isNamed(file, path) ? path : "";
}

}  // namespace hybrid_slam::files
