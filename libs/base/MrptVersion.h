/// @file MrptVersion.h
/// @brief Differences between MRPT 2.5.8 (Debian 12) and 2.14.7 (Debian 13).
#pragma once

#include <mrpt/version.h>  // MRPT_VERSION: 0x258 for 2.5.8, 0x20e07 for 2.14.7

#include <memory>

namespace mrpt::maps {
class CMetricMap;
class CMultiMetricMap;
}  // namespace mrpt::maps

namespace hybrid_slam {

/// What the factories of maps (`internal_CreateFromMapDefinition`) return.
#if MRPT_VERSION >= 0x20e00
using CreatedMetricMap = std::shared_ptr<mrpt::maps::CMetricMap>;
#else
using CreatedMetricMap = mrpt::maps::CMetricMap*;
#endif

/// @name CMetricMapBuilder::getCurrentlyBuiltMetricMap returns a pointer in 2.5.8, a reference in 2.14.7.
/// @{
#if MRPT_VERSION >= 0x20e00
using BuiltMetricMap = const mrpt::maps::CMultiMetricMap&;
/// Returns the maps as that function must.
inline BuiltMetricMap builtMetricMap(const mrpt::maps::CMultiMetricMap& map) { return map; }
#else
using BuiltMetricMap = const mrpt::maps::CMultiMetricMap*;
/// Returns the maps as that function must.
inline BuiltMetricMap builtMetricMap(const mrpt::maps::CMultiMetricMap& map) { return &map; }
#endif

/// Returns the maps that the function has returned.
inline const mrpt::maps::CMultiMetricMap& asReference(const mrpt::maps::CMultiMetricMap& map) { return map; }
/// Returns the maps that the function has returned.
inline const mrpt::maps::CMultiMetricMap& asReference(const mrpt::maps::CMultiMetricMap* map) { return *map; }
/// @}

}  // namespace hybrid_slam
