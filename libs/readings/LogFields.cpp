#include "readings/LogFields.h"

#include <algorithm>
#include <cmath>

#include "base/Numbers.h"
#include "readings/LogParser.h"

namespace hybrid_slam::readings {
namespace {

constexpr std::string_view kBlank = " \t\r\f\v";

}  // namespace

LogFields::LogFields(std::string_view line) {
  for (size_t begin = line.find_first_not_of(kBlank); begin != std::string_view::npos;) {
    const size_t end = std::min(line.find_first_of(kBlank, begin), line.size());
    fields_.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kBlank, end);
  }
}

void LogFields::expectLeft(size_t count, const std::string& what) const {
  if (left() == count) return;
  throw BrokenLine(std::to_string(left()) + " fields where " + std::to_string(count) +
                   " were expected: " + what);
}

bool LogFields::isZero(size_t skipped, size_t count) const {
  if (left() < skipped + count) return false;
  const auto first = fields_.begin() + static_cast<std::ptrdiff_t>(next_ + skipped);
  return std::all_of(first, first + static_cast<std::ptrdiff_t>(count),
                     [](std::string_view field) { return parseNumber(field) == 0.0; });
}

std::string_view LogFields::word() {
  if (empty()) throw BrokenLine("truncated line");
  return fields_[next_++];
}

double LogFields::anyNumber() {
  const std::string_view field = word();
  const auto value = parseNumber(field);
  if (!value) throw BrokenLine(inBackquotes(field) + " is not a number");
  return *value;
}

double LogFields::number() {
  const double value = anyNumber();
  if (!std::isfinite(value)) throw BrokenLine(inBackquotes(fields_[next_ - 1]) + " is not a finite number");
  return value;
}

float LogFields::range() { return static_cast<float>(anyNumber()); }

size_t LogFields::count(size_t least) {
  const double value = number();
  if (value < static_cast<double>(least) || value > 1e6 || value != std::floor(value))
    throw BrokenLine(inBackquotes(fields_[next_ - 1]) + " is not a valid number of readings");
  return static_cast<size_t>(value);
}

double LogFields::time() {
  const double value = number();
  if (value < 0 || value > kLatestTime) throw BrokenLine(inBackquotes(fields_[next_ - 1]) + " is not a time");
  return value;
}

mrpt::math::TPose2D LogFields::pose() {
  const double x = number(), y = number(), theta = number();
  return {x, y, theta};
}

std::string inBackquotes(std::string_view field) {
  constexpr size_t kLongest = 24;
  std::string text = "`";
  for (const char c : field.substr(0, kLongest)) text += c > ' ' && c < '\x7f' ? c : '?';
  return text + (field.size() > kLongest ? "...`" : "`");
}

}  // namespace hybrid_slam::readings
