#include "readings/TextLog.h"

#include <utility>

#include "base/Errors.h"
#include "readings/LogFields.h"

namespace hybrid_slam::readings {
namespace {

/// Lists the formats: `CARMEN: FLASER, RLASER, ROBOTLASER1; DP-SLAM: Laser`.
std::string formatList() {
  std::string all;
  for (const LogFormat* format : logFormats())
    all += (all.empty() ? "" : "; ") + std::string(format->name) + ": " + format->rows;
  return all;
}

/// Shows the parser how the log begins.
void preview(files::LineReader& lines, LogParser& parser) {
  std::string line;
  try {
    for (size_t i = 0; i < LogParser::kPreviewLines && lines.next(line); ++i) parser.preview(line);
  } catch (const InputError&) {
    // Damage: reading the log will report it at its place.
  }
  lines.rewind();
}

const LogFormat* recogniseFormat(files::LineReader& lines) {
  std::string line;
  while (lines.next(line)) {
    if (const LogFormat* format = formatOf(line)) {
      lines.rewind();
      return format;
    }
  }
  throw InputError("not a robot log", lines.path(), "expected rows of scans (" + formatList() + ")");
}

}  // namespace

TextLog::TextLog(const std::string& file, const LogConversionOptions& options, BrokenLineReport report)
    : lines_(file), strict_(options.strict), report_(std::move(report)) {
  const LogFormat* const format = options.format ? options.format : recogniseFormat(lines_);
  parser_ = format->makeParser(options);
  preview(lines_, *parser_);
  objects_ = std::make_unique<LogObjects>(options.maxRange.value_or(format->maxRange),
                                          options.actionObservation, options.sweep);
  objects_->summary.format = format->name;
}

mrpt::serialization::CSerializable::Ptr TextLog::next() {
  std::string line;
  auto object = objects_->take();
  while (!object && lines_.next(line)) {
    convert(line);
    object = objects_->take();
  }
  if (!object && summary().scans == 0)
    throw InputError("no laser scan", lines_.path() + firstBroken_,
                     "expected whole rows of scans (" + formatList() + ")");
  return object;
}

void TextLog::convert(const std::string& line) {
  try {
    std::visit(*objects_, parser_->parse(line));
    objects_->summary.areAt(lines_.number());
  } catch (const BrokenLine& broken) {
    if (strict_)
      throw InputError("broken line", lines_.path() + ", line " + std::to_string(lines_.number()),
                       broken.what());
    if (objects_->summary.brokenLines++ == 0)
      firstBroken_ = ", first broken line " + std::to_string(lines_.number()) + " (" + broken.what() + ")";
    report_(lines_.number(), broken.what());
  }
}

}  // namespace hybrid_slam::readings
