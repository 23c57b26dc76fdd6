/// @file Locks.h
/// @brief Locks of open files and folders, which end with the process that holds them.
#pragma once

#include <string>

namespace hybrid_slam::files {

/// Whose the lock of an open file is; some network file systems have none.
enum class Lock { held, ofAnother, unsupported };

/// Locks an open file or folder until it is closed, unless another opening of it, in any process, has the
/// lock.
Lock lock(int file);
/// The same, for a lock that several may hold at a time, but not beside one that `lock` gives.
Lock lockShared(int file);

/// Returns whether an open file or folder still has this name; false for a symbolic link to it.
bool isNamed(int file, const std::string& path);
/// Returns a path of an open file or folder, which may have been moved since; empty if it was removed.
std::string pathOf(int file);

}  // namespace hybrid_slam::files
