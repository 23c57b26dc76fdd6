#include "study/simulation/RecordFile.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <sstream>

#include "base/Errors.h"
#include "base/Numbers.h"
#include "base/Options.h"
#include "files/LineReader.h"

namespace hybrid_slam::simulation {
namespace {

constexpr double kLargestNumber = 1e5;  // m, s, deg: a building has no more
constexpr size_t kLongestWord = 100;    // the nearest known word is searched for
constexpr size_t kMostRecords = 20000, kMostNumbers = 100000;

}  // namespace

std::vector<Record> readRecords(const std::string& file, const std::vector<std::string>& words) {
  std::error_code ignored;
  const bool isFile = std::filesystem::is_regular_file(file, ignored);  // a pipe would wait for its writer
  if (!isFile || ::access(file.c_str(), R_OK) != 0)
    throw InputError("cannot be read", "file " + file, "expected a readable text file");
  files::LineReader in(file);
  std::vector<Record> records;
  std::string line;
  size_t numbers = 0;
  while (in.next(line)) {
    std::istringstream parts(line.substr(0, line.find('#')));
    Record record;
    if (!(parts >> record.word)) continue;
    record.where = "file " + file + ", line " + std::to_string(in.number());
    record.word.resize(std::min(record.word.size(), kLongestWord));
    if (std::find(words.begin(), words.end(), record.word) == words.end())
      throw InputError("unknown word `" + record.word + "`", record.where,
                       "the nearest known word is `" + nearestName(record.word, words) + "`");
    for (std::string text; parts >> text;) {
      const auto value = parseFinite(text);
      if (!value)
        throw InputError("`" + text + "` is not a number", record.where,
                         "expected only numbers after the word");
      if (std::abs(*value) > kLargestNumber)
        throw InputError("`" + text + "` is too large", record.where, "expected a number in -100000..100000");
      if (++numbers > kMostNumbers)
        throw InputError("too many numbers", record.where,
                         "expected at most " + std::to_string(kMostNumbers));
      record.numbers.push_back(*value);
    }
    if (records.size() == kMostRecords)
      throw InputError("too many lines", record.where, "expected at most " + std::to_string(kMostRecords));
    records.push_back(std::move(record));
  }
  return records;
}

void expectNumbers(const Record& record, const std::string& names) {
  std::istringstream parts(names);
  const auto count = std::distance(std::istream_iterator<std::string>(parts), {});
  if (static_cast<size_t>(count) != record.numbers.size())
    throw InputError("`" + record.word + "` with " + std::to_string(record.numbers.size()) + " numbers",
                     record.where, "expected `" + record.word + " " + names + "`");
}

}  // namespace hybrid_slam::simulation
