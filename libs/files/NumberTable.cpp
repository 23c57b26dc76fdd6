#include "files/NumberTable.h"

#include <mrpt/system/string_utils.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string_view>

#include "base/Errors.h"
#include "base/Numbers.h"
#include "files/LineReader.h"

namespace hybrid_slam::files {
namespace {

// Not by streams, which take most of the time of a long trajectory.
std::vector<std::string> words(const std::string& line) {
  std::vector<std::string> result;
  mrpt::system::tokenize(line, " \t\r\v\f", result);
  return result;
}

std::vector<std::string> cells(const std::string& line) {
  const std::string text = line.substr(0, line.find('\r'));
  std::vector<std::string> result;
  for (size_t from = 0, to; from < text.size(); from = to + 1) {
    to = std::min(text.find(',', from), text.size());
    result.push_back(text.substr(from, to - from));
  }
  return result;
}

constexpr size_t kMostRows = 5'000'000;    // of 8 numbers: 0.6 GB; 34 hours at 40 Hz
constexpr size_t kMostLines = 20'000'000;  // empty ones and comments too

/// Calls `use` for each line. zlib also reads plain files.
void forEachLine(const std::string& file, const std::string& expected,
                 const std::function<void(const std::string& line, size_t number)>& use) {
  const std::string where = "file `" + file + "`";
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> input(gzopen(file.c_str(), "rb"), gzclose);
  if (!input) throw InputError("cannot open the file", where, expected);
  std::string line;
  size_t number = 1;
  const auto give = [&] {
    if (number == 1) removeByteOrderMark(line);
    use(line, number++);
    line.clear();
  };
  std::vector<char> buffer(1 << 16);
  int count = 0;
  while ((count = gzread(input.get(), buffer.data(), static_cast<unsigned>(buffer.size()))) > 0)
    for (const char c : std::string_view(buffer.data(), static_cast<size_t>(count))) {
      if (c == '\n') {
        if (number == kMostLines)
          throw InputError("too many lines", where, "expected at most " + std::to_string(kMostLines));
        give();
      } else if (line.size() < kLongestLine) {
        line += c;
      } else {
        throw InputError("line too long", where + ", line " + std::to_string(number), expected);
      }
    }
  int state = Z_OK;
  gzerror(input.get(), &state);  // gzread reports no error for a truncated gzip file
  if (count < 0 || state != Z_OK) throw InputError("cannot read the file", where, expected);
  if (!line.empty()) give();
}

}  // namespace

std::vector<NumberRow> readNumberTable(const std::string& file, const std::string& columns) {
  const bool isCsv = columns.find(',') != std::string::npos;
  const auto split = isCsv ? cells : words;
  const size_t width = split(columns).size();
  const std::string expected = "expected lines of " + std::to_string(width) + " numbers, `" + columns + "`";

  std::vector<NumberRow> rows;
  forEachLine(file, expected, [&](const std::string& line, size_t number) {
    const std::vector<std::string> entries = split(line);
    if (isCsv && number == 1 && entries == split(columns)) return;
    if (isCsv && number == 1)
      throw InputError("wrong header", "file `" + file + "`", "expected `" + columns + "`");
    if (entries.empty() || line.front() == '#') return;
    NumberRow row{number, {}};
    for (const std::string& entry : entries) {
      const auto value = parseFinite(entry);
      if (!value) break;
      row.values.push_back(*value);
    }
    if (entries.size() != width || row.values.size() != width)
      throw InputError("broken line", "file `" + file + "`, line " + std::to_string(number), expected);
    if (rows.size() == kMostRows)
      throw InputError("too many rows", "file `" + file + "`, line " + std::to_string(number),
                       "expected at most " + std::to_string(kMostRows));
    rows.push_back(std::move(row));
  });
  if (rows.empty()) throw InputError("the file is empty", "file `" + file + "`", expected);
  return rows;
}

void checkPose(const NumberRow& row, const std::string& file, std::initializer_list<size_t> coordinates,
               std::initializer_list<size_t> angles) {
  constexpr double kLargest = 1e7;  // m: from the equator to a pole, which UTM's northings reach; rad
  const auto check = [&](std::initializer_list<size_t> columns, const char* expected) {
    for (const size_t column : columns)
      if (!(std::abs(row.values[column]) <= kLargest))
        throw InputError("broken line", "file `" + file + "`, line " + std::to_string(row.line), expected);
  };
  check(coordinates, "expected coordinates in -1e7..1e7 m");
  check(angles, "expected angles in -1e7..1e7 rad");
}

}  // namespace hybrid_slam::files
