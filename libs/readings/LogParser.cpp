#include "readings/LogParser.h"

#include <algorithm>

#include "readings/LogFields.h"

namespace hybrid_slam::readings {
namespace {

/// Returns whether a word can be a message name, which is in capitals: `SYNC`, `NMEA-GGA`, `SM_UPDATE`.
bool isRecordName(std::string_view word) {
  return word.size() <= 32 && word.front() >= 'A' && word.front() <= 'Z' &&
         std::all_of(word.begin(), word.end(), [](char c) {
           return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
         });
}

}  // namespace

LogRecord LogParser::parse(std::string_view line) {
  LogFields fields(line);
  if (fields.empty()) return {};
  const std::string_view name = fields.word();
  if (name.front() == '#') return {};
  return record(name, fields);
}

LogRecord LogParser::otherRecord(std::string_view name) {
  if (!isRecordName(name)) throw BrokenLine(inBackquotes(name) + " is not a record's name");
  return OtherRecord{std::string(name)};
}

std::vector<float> LogParser::ranges(size_t beams, LogFields& fields) {
  std::vector<float> values(beams);
  for (float& value : values) value = fields.range();
  return values;
}

LaserRecord LogParser::scan(std::string_view name, size_t beams, LogFields& fields) const {
  const std::optional<double> step = options_.angularStep ? options_.angularStep : angularStepFor(beams);
  if (!step)
    throw BrokenLine("no known laser has " + std::to_string(beams) +
                     " beams: the angular step must be given");
  LaserRecord record;
  record.label = name;
  record.angles = beamAngles(beams, *step);
  record.ranges = ranges(beams, fields);
  return record;
}

}  // namespace hybrid_slam::readings
