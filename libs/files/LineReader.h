/// @file LineReader.h
/// @brief The lines of a text file, plain or gzipped, one at a time.
#pragma once

#include <memory>
#include <string>
#include <vector>

struct gzFile_s;

namespace hybrid_slam::files {

/// Reads a text file as a stream: memory does not grow with the file. Whether it is gzipped is told from
/// its content, not from its name.
class LineReader {
 public:
  /// @throws InputError if the file is missing, not a file, or not readable
  explicit LineReader(const std::string& path);

  /// The next line without its end; false after the last one. A last line without an end counts.
  /// @throws InputError where a gzipped file is cut off or damaged, for a read error, and for a line longer
  /// than 1 MiB (no text log has one)
  bool next(std::string& line);
  /// Number of the line that `next` gave last, from 1.
  size_t number() const { return number_; }
  const std::string& path() const { return path_; }
  void rewind();

 private:
  bool fill();

  std::string path_;
  std::unique_ptr<gzFile_s, int (*)(gzFile_s*)> file_;
  std::vector<char> buffer_;
  size_t position_ = 0, end_ = 0;  // of what is in the buffer and not yet given
  size_t number_ = 0;
};

}  // namespace hybrid_slam::files
