/// @file ReportText.h
/// @brief Text and numbers as the report shows them.
#pragma once

#include <string>

namespace hybrid_slam::comparison {

/// `&`, `<`, `>` and `"` as XML wants them; control characters as `?`.
std::string escapeXml(const std::string& text);
/// A number in at most `digits` significant digits, without an exponent where possible, in every locale the
/// same.
std::string shortNumber(double value, int digits = 4);

}  // namespace hybrid_slam::comparison
