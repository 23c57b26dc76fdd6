/// @file ReportText.h
/// @brief Text and numbers as the report shows them.
#pragma once

#include <string>

namespace hybrid_slam::comparison {

/// `&`, `<`, `>` and `"` escaped for XML; control characters become `?`.
std::string escapeXml(const std::string& text);
/// A number in at most `digits` significant digits, without an exponent if possible; the same in every
/// locale.
std::string shortNumber(double value, int digits = 4);

}  // namespace hybrid_slam::comparison
