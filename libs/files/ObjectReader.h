/// @file ObjectReader.h
/// @brief Builds serialised MRPT objects from bytes that are checked first.
#pragma once

#include <mrpt/serialization/CSerializable.h>

#include <string_view>

namespace hybrid_slam::files {

/// Builds an object from bytes that an ObjectWalk has stepped over: MRPT trusts every length, class and
/// depth.
/// @throws std::exception if MRPT does not accept the contents
mrpt::serialization::CSerializable::Ptr buildObject(std::string_view bytes);

/// Returns whether RawlogReader and observation-server's clients read observations of this class.
bool isReadable(const mrpt::serialization::CSerializable& object);

}  // namespace hybrid_slam::files
