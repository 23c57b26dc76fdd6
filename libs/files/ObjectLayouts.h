/// @file ObjectLayouts.h
/// @brief The classes of logs and maps that are read, and their fields in MRPT's format.
#pragma once

#include <string_view>

#include "files/ObjectWalk.h"

namespace hybrid_slam::files {

/// Largest size of a grid map: MRPT computes its size in 32 bits.
constexpr size_t kMostGridMapCells = size_t{1} << 28;

struct ObjectLayout {
  std::string_view name;  ///< without namespace
  ObjectKind kind;
  int versions;                                 ///< 0 .. versions - 1
  void (*fields)(ObjectWalk& in, int version);  ///< steps over them
};

/// Null for a class that is not listed. @param name  with or without namespace
const ObjectLayout* layoutOf(std::string_view name);

/// The class name without namespaces.
std::string_view baseName(std::string_view name);

}  // namespace hybrid_slam::files
