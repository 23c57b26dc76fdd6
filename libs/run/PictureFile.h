/// @file PictureFile.h
/// @brief Decodes the picture formats of maps.
#pragma once

#include <string>

#include "run/GreyPicture.h"

namespace hybrid_slam::run {

/// @throws std::runtime_error that says what is wrong
GreyPicture decodePgm(const std::string& bytes);
/// Decodes a PNG file of at most 2^28 pixels. @throws std::runtime_error that says what is wrong
GreyPicture decodePng(const std::string& bytes);

/// @throws std::runtime_error for no pixels, more than 2^28, or more than 2^20 per side
void checkSize(size_t width, size_t height);

}  // namespace hybrid_slam::run
