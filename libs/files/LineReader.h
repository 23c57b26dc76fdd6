/// @file LineReader.h
/// @brief The lines of a text file, plain or compressed, one at a time.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace hybrid_slam::files {

class CompressedFile;

constexpr size_t kLongestLine = 1 << 20;  ///< bytes; no text log and no table has longer ones

/// Removes the byte order mark that some editors write at the beginning of a UTF-8 file.
/// @param line  the first one of the file
void removeByteOrderMark(std::string& line);

/// Reads a text file as a stream with constant memory. Compression (CompressedFile.h) is detected from
/// the content, not the name.
class LineReader {
 public:
  /// @throws InputError if the file is missing, not a file, or not readable
  explicit LineReader(const std::string& path);
  ~LineReader();
  LineReader(const LineReader&) = delete;
  LineReader& operator=(const LineReader&) = delete;

  /// Reads the next line, without its line break and the file's byte order mark; returns false after the last
  /// one. The last line may lack a line break.
  /// @throws InputError for a truncated or damaged compressed file, for a read error, and for a line longer
  ///         than 1 MiB, which no text log has
  bool next(std::string& line);
  /// Returns the number of the last line read, from 1.
  size_t number() const { return number_; }
  const std::string& path() const { return path_; }
  void rewind();

 private:
  bool fill();
  bool count(std::string& line);

  std::string path_;
  std::unique_ptr<CompressedFile> file_;
  std::vector<char> buffer_;
  size_t position_ = 0, end_ = 0;  // unread part of the buffer
  size_t number_ = 0;
};

/// Returns whether a file, plain or compressed, starts with text: no byte of its first 512 is zero. A rawlog
/// has zeros there. False for an empty or unreadable file.
bool isText(const std::string& path);

}  // namespace hybrid_slam::files
