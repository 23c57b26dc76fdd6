/// @file ObjectLayouts.h
/// @brief The classes that are read from logs and maps, and their fields in MRPT's format.
#pragma once

#include <string_view>

#include "files/ObjectWalk.h"

namespace hybrid_slam::files {

/// Largest number of cells of a grid map: MRPT computes it in 32 bits.
constexpr size_t kMostGridMapCells = size_t{1} << 28;

/// The layout of one class, in all versions that MRPT reads.
struct ObjectLayout {
  std::string_view name;  ///< without namespace
  ObjectKind kind;
  int versions;                                 ///< 0 .. versions - 1
  void (*fields)(ObjectWalk& in, int version);  ///< steps over them
};

/// Returns the layout of a class; null if it is not listed. @param name  with or without namespace
const ObjectLayout* layoutOf(std::string_view name);

/// Returns the class name without namespaces.
std::string_view baseName(std::string_view name);

}  // namespace hybrid_slam::files
