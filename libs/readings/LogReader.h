/// @file LogReader.h
/// @brief Reads a log in any format: rawlog, text log or bag.
#pragma once

#include <mrpt/serialization/CSerializable.h>

#include <memory>
#include <string>
#include <vector>

namespace hybrid_slam::files {
class RawlogReader;
}

namespace hybrid_slam::readings {

class BagLog;
class TextLog;
struct BagPlan;

/// Reads a log, plain or compressed, as a stream. The format is detected from the content. A text log or bag
/// gives the objects that log2rawlog writes without options.
class LogReader {
 public:
  /// @param plan  of a bag; null: the default
  /// @throws InputError if the file is missing or unreadable, if a text file is not a log, or if the topics
  ///         of a bag are ambiguous
  explicit LogReader(const std::string& file, const std::shared_ptr<const BagPlan>& plan = nullptr);
  ~LogReader();
  LogReader(const LogReader&) = delete;
  LogReader& operator=(const LogReader&) = delete;

  /// Returns the next object; null at the end, or where the log is truncated or broken (see `defect`).
  /// @throws InputError if the first object is not a rawlog object, or if a text log has no scan
  mrpt::serialization::CSerializable::Ptr next();

  size_t entry() const;               ///< number of the last object, or of its line
  const char* unit() const;           ///< of `entry`: "entry", "line" or "message"
  const std::string& defect() const;  ///< empty for an intact log
  /// Returns the reader of a rawlog; null for a text log or bag.
  const files::RawlogReader* rawlog() const { return rawlog_.get(); }
  size_t brokenLines() const { return brokenLines_; }  ///< skipped lines of a text log, or messages of a bag
  size_t firstBroken() const { return firstBroken_; }  ///< number of the first
  /// Returns a line for each laser of a text log whose rows have been skipped: its name and the reason.
  std::vector<std::string> ignoredLasers() const;

 private:
  std::string file_;
  std::unique_ptr<files::RawlogReader> rawlog_;
  std::unique_ptr<TextLog> text_;
  std::unique_ptr<BagLog> bag_;
  std::string textDefect_;
  size_t brokenLines_ = 0, firstBroken_ = 0;
};

}  // namespace hybrid_slam::readings
