/// @file GreyPicture.h
/// @brief Reads the grey values of an untrusted picture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace hybrid_slam::run {

/// The pixels of a picture.
struct GreyPicture {
  size_t width = 0, height = 0;
  std::vector<uint8_t> grey;        ///< 0 black .. 255 white, row by row from the top; mean of colours
  std::vector<bool> isTransparent;  ///< at least partly; empty if no pixel is

  size_t index(size_t column, size_t row) const { return row * width + column; }
};

/// Reads a PGM (P2, P5) or PNG file of at most 2^28 pixels, 2^20 on a side; the content counts, not the name.
/// Memory is taken only for pixels that the file holds.
/// @throws InputError for a file of another format, cut off, damaged or too large
GreyPicture readGreyPicture(const std::string& file);

}  // namespace hybrid_slam::run
