/// @file RecordFile.h
/// @brief The text form that floor plans and routes share: one word and its numbers on each line.
#pragma once

#include <string>
#include <vector>

namespace hybrid_slam::simulation {

/// One line `word number number ...`; `#` starts a comment, empty lines count only as numbers.
struct Record {
  std::string word;
  std::vector<double> numbers;
  std::string where;  ///< "file F, line N", for errors
};

/// @param words  the words that the file may use
/// @throws InputError for an unreadable file, an unknown word, something that is not a finite number
std::vector<Record> readRecords(const std::string& file, const std::vector<std::string>& words);

/// @throws InputError unless the record holds as many numbers as `names` (space-separated) has names
void expectNumbers(const Record& record, const std::string& names);

}  // namespace hybrid_slam::simulation
