/// @file RecordFile.h
/// @brief The text format of floor plans and routes: a word and its numbers per line.
#pragma once

#include <string>
#include <vector>

namespace hybrid_slam::simulation {

constexpr double kTolerance = 1e-3;  ///< m, of hand-typed coordinates

/// One line `word number number ...`; `#` starts a comment; empty lines only count for line numbers.
struct Record {
  std::string word;
  std::vector<double> numbers;
  std::string where;  ///< "file F, line N", for errors
};

/// @param words  allowed words
/// @throws InputError for an unreadable file, an unknown word, a number that is not finite or beyond 1e5, and
///         more than 20,000 records
std::vector<Record> readRecords(const std::string& file, const std::vector<std::string>& words);

/// @throws InputError unless the record has one number per name in `names` (space-separated)
void expectNumbers(const Record& record, const std::string& names);

}  // namespace hybrid_slam::simulation
