/// @file MapPictures.h
/// @brief The report's pictures of whole maps.
#pragma once

#include <string>

#include "study/comparison/Report.h"

namespace hybrid_slam::comparison {

/// The map of the median run and of the worst run of each group, as `<figure>` elements: `map.png`, reduced.
std::string mapPictures(const ReportInput& input);

/// Reduces a PNG to at most 700 pixels a side and 16 levels per colour; large ones shrink to a tenth of their
/// bytes.
/// @returns the PNG; empty if the input is not a picture
std::string reducedPicture(const std::string& png);

/// Bytes as base64 (RFC 4648) without the line breaks that MRPT inserts.
std::string base64(const std::string& bytes);

}  // namespace hybrid_slam::comparison
