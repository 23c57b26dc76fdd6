/// @file Numbers.h
/// @brief Locale-independent number formatting and parsing: decimal point, no separators.
///
/// mrpt::format and streams write a decimal comma in some locales, which no file format here allows.
#pragma once

#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace hybrid_slam {

/// Parses the whole text as a number; accepts `nan`, `inf` and a leading `+`.
std::optional<double> parseNumber(std::string_view text);
/// Parses the whole text as a finite number.
std::optional<double> parseFinite(std::string_view text);

/// Formats like printf's %.Nf, %.Ne or %.Ng.
std::string numberText(double value, std::chars_format format, int precision);
/// Formats like printf's %.Nf.
std::string fixedText(double value, int decimals);
/// Returns a number and what it counts, in which `(s)` marks the plural: counted(1, "scan(s) skipped").
std::string counted(size_t number, std::string what);
/// Decimal text with at least 6 significant digits that parses back to the same number.
std::string numberText(double value);

}  // namespace hybrid_slam
