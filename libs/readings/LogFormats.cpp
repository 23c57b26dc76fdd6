#include "readings/LogFormats.h"

#include <algorithm>
#include <iterator>
#include <sstream>

#include "base/Numbers.h"
#include "readings/LogFields.h"

namespace hybrid_slam::readings {
namespace {

constexpr const char* kBagEndings[] = {".bag", ".db3", ".mcap"};

/// Returns `a, b or c`.
std::string alternatives(const std::vector<std::string>& items) {
  std::string all;
  for (size_t i = 0; i < items.size(); ++i)
    all += (i == 0 ? "" : i + 1 < items.size() ? ", " : " or ") + items[i];
  return all;
}

}  // namespace

std::vector<std::string> logEndings() {
  std::vector<std::string> all{".rawlog"};
  for (const LogFormat* format : logFormats()) {
    std::istringstream endings(format->endings);
    for (std::string ending; endings >> ending;)
      if (std::find(all.begin(), all.end(), ending) == all.end()) all.push_back(ending);
  }
  all.insert(all.end(), std::begin(kBagEndings), std::end(kBagEndings));
  all.insert(all.end(), {".gz", ".bz2", ".zstd", ".zst", ".lz4"});
  return all;
}

std::string robotLogs() {
  std::vector<std::string> bags(std::begin(kBagEndings), std::end(kBagEndings)), texts;
  bags.emplace_back("folder");
  for (const LogFormat* format : logFormats()) texts.emplace_back(format->name);
  return "bag of ROS 1 or 2 (" + alternatives(bags) + "), or text log of " + alternatives(texts) +
         "; plain or compressed with gzip, bzip2, zstd or LZ4";
}

std::string defaultMaxRanges() {
  std::string all;
  double last = 0;
  for (const LogFormat* format : logFormats()) {
    if (!all.empty()) all += format->maxRange == last ? ", " : ": " + numberText(last) + "; ";
    all += format->name;
    last = format->maxRange;
  }
  return all + ": " + numberText(last);
}

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
