/// @file RawlogReader.h
/// @brief The objects of a rawlog one by one, with its end told from its being cut off.
#pragma once

#include <mrpt/serialization/CSerializable.h>

#include <memory>
#include <string>

namespace hybrid_slam::files {

/// Reads a rawlog, plain or gzipped, as a stream: memory does not grow with the log.
class RawlogReader {
 public:
  /// @throws InputError if the file is missing or unreadable
  explicit RawlogReader(const std::string& file);
  ~RawlogReader();
  RawlogReader(const RawlogReader&) = delete;
  RawlogReader& operator=(const RawlogReader&) = delete;

  /// The next object; null at the end, or where the log is cut off or broken (then `defect` says how).
  /// @throws InputError if the very first object is none that a rawlog holds
  mrpt::serialization::CSerializable::Ptr next();

  size_t entry() const { return entry_; }                ///< objects read so far
  const std::string& defect() const { return defect_; }  ///< empty for a log that ended as it should

 private:
  struct Stream;
  std::string file_;
  std::unique_ptr<Stream> stream_;
  size_t entry_ = 0;
  std::string defect_;
};

}  // namespace hybrid_slam::files
