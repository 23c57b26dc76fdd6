#include "files/Locks.h"

#include <sys/file.h>
#include <sys/stat.h>

#include <cerrno>

namespace hybrid_slam::files {

Lock lock(int file) {
  if (::flock(file, LOCK_EX | LOCK_NB) == 0) return Lock::held;
  return errno == EWOULDBLOCK ? Lock::ofAnother : Lock::unsupported;
}

bool isNamed(int file, const std::string& path) {
  struct stat opened {
  }, named{};
  return ::fstat(file, &opened) == 0 && ::stat(path.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
         opened.st_ino == named.st_ino;
}

}  // namespace hybrid_slam::files
