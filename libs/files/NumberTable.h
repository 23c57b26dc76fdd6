/// @file NumberTable.h
/// @brief Text files of numbers, plain or gzipped: trajectories, odometry, relations.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <vector>

namespace hybrid_slam::files {

/// One row of a table and its line number (from 1).
struct NumberRow {
  size_t line = 0;
  std::vector<double> values;
};

/// Reads the rows of a table in file order; empty lines and lines that begin with `#` are skipped.
/// @param columns  column names separated by blanks, "t x y theta", or by commas as in the file, "t,x,y": the
///                 first line of the file is then this header
/// @throws InputError for an unreadable or truncated file, for another header, for a line without exactly one
/// finite number per column or of over 1 MiB (with its number), and for a file without rows.
std::vector<NumberRow> readNumberTable(const std::string& file, const std::string& columns);

/// Checks a row's columns of coordinates and of angles: the sums of squares of an evaluation must not
/// overflow.
/// @throws InputError with the line for a coordinate beyond 10,000 km or an angle beyond 1e7 rad
void checkPose(const NumberRow& row, const std::string& file, std::initializer_list<size_t> coordinates,
               std::initializer_list<size_t> angles);

}  // namespace hybrid_slam::files
