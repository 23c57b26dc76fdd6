/// @file RawlogReader.h
/// @brief Reads the objects of a rawlog one by one and detects truncation.
#pragma once

#include <mrpt/serialization/CSerializable.h>

#include <memory>
#include <string>

namespace hybrid_slam::files {

/// Reads a rawlog, plain or gzipped, as a stream with constant memory.
class RawlogReader {
 public:
  /// @throws InputError if the file is missing or unreadable
  explicit RawlogReader(const std::string& file);
  ~RawlogReader();
  RawlogReader(const RawlogReader&) = delete;
  RawlogReader& operator=(const RawlogReader&) = delete;

  /// The next object; null at the end, or where the log is truncated or broken (see `defect`).
  /// @throws InputError if the first object is not a rawlog object
  mrpt::serialization::CSerializable::Ptr next();

  size_t entry() const { return entry_; }                ///< objects read so far
  const std::string& defect() const { return defect_; }  ///< empty for an intact log

 private:
  struct Stream;
  std::string file_;
  std::unique_ptr<Stream> stream_;
  size_t entry_ = 0;
  std::string defect_;
};

}  // namespace hybrid_slam::files
