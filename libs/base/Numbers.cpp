#include "base/Numbers.h"

#include <cmath>

namespace hybrid_slam {

std::optional<double> parseNumber(std::string_view text) {
  if (text.substr(0, 1) == "+" && text.substr(1, 1) != "-") text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<double> parseFinite(std::string_view text) {
  const auto value = parseNumber(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::string numberText(double value, std::chars_format format, int precision) {
  char text[400];  // the largest double has 309 digits before the decimal point
  const auto [end, error] = std::to_chars(text, text + sizeof text, value, format, precision);
  return {text, end};
}

std::string fixedText(double value, int decimals) {
  return numberText(value, std::chars_format::fixed, decimals);
}

std::string numberText(double value) {
  constexpr int kFewest = 6, kEnough = 17;
  std::string text;
  for (int digits = kFewest; digits <= kEnough; ++digits) {
    text = numberText(value, std::chars_format::general, digits);
    if (parseNumber(text) == value) break;
  }
  return text;
}

std::string counted(size_t number, std::string what) {
  constexpr std::string_view kMark = "(s)";
  const std::string ending = number == 1 ? "" : "s";
  for (size_t at = 0; (at = what.find(kMark, at)) != std::string::npos; at += ending.size())
    what.replace(at, kMark.size(), ending);
  return std::to_string(number) + " " + what;
}

}  // namespace hybrid_slam
