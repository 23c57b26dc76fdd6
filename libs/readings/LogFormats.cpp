#include "readings/LogFormats.h"

#include "readings/LogFields.h"

namespace hybrid_slam::readings {

const LogFormat* formatOf(std::string_view line) {
  LogFields fields(line);
  if (fields.empty()) return nullptr;
  const std::string_view name = fields.word();
  for (const LogFormat* format : logFormats())
    if (format->isRow(name, fields.left())) return format;
  return nullptr;
}

const LogFormat* formatNamed(std::string_view key) {
  for (const LogFormat* format : logFormats())
    if (format->key == key) return format;
  return nullptr;
}

}  // namespace hybrid_slam::readings
