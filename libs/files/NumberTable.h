/// @file NumberTable.h
/// @brief Text files of numbers, plain or gzipped: trajectories, odometry, relations.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace hybrid_slam::files {

/// One row of a table and the line of the file where it stands (from 1).
struct NumberRow {
  size_t line = 0;
  std::vector<double> values;
};

/// Reads the rows of a table in file order; empty lines and lines that begin with `#` are passed over.
/// @param columns  the names of the columns, separated by blanks: "t x y theta"
/// @throws InputError for a file that cannot be read to its end, for a line that does not hold one finite
///         number for each column (naming the line), and for a file without rows.
std::vector<NumberRow> readNumberTable(const std::string& file, const std::string& columns);

}  // namespace hybrid_slam::files
