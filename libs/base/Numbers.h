/// @file Numbers.h
/// @brief Numbers as text, the same in every locale: a decimal point and no separators.
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>

namespace hybrid_slam {

/// The number that the whole text is, `nan` and `inf` among them; a `+` may lead it.
std::optional<double> parseNumber(std::string_view text);
/// The same without `nan` and `inf`.
std::optional<double> parseFinite(std::string_view text);

/// printf's %.Nf, %.Ne or %.Ng.
std::string numberText(double value, std::chars_format format, int precision);
/// printf's %.Nf.
std::string fixedText(double value, int decimals);
/// Decimal text of at least 6 significant digits that reads back to the same number.
std::string numberText(double value);

}  // namespace hybrid_slam
