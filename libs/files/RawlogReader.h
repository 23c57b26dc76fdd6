/// @file RawlogReader.h
/// @brief Reads the objects of a rawlog one by one and detects truncation.
#pragma once

#include <mrpt/serialization/CSerializable.h>

#include <memory>
#include <set>
#include <string>
#include <vector>

namespace hybrid_slam::files {

class ObjectFile;

/// Reads a rawlog, plain or compressed, as a stream with constant memory. Every object is
/// checked before it is built.
class RawlogReader {
 public:
  /// @throws InputError if the file is missing or unreadable
  explicit RawlogReader(const std::string& file);
  ~RawlogReader();
  RawlogReader(const RawlogReader&) = delete;
  RawlogReader& operator=(const RawlogReader&) = delete;

  /// Returns the next object; null at the end, or where the log is truncated or broken (see `defect`).
  /// @throws InputError if the first object is not a rawlog object
  /// @throws std::bad_alloc
  mrpt::serialization::CSerializable::Ptr next();

  size_t entry() const { return entry_; }                ///< objects read so far
  const std::string& defect() const { return defect_; }  ///< empty for an intact log

  /// Number of observations of unlisted classes (ObjectLayouts.h), which are skipped, also within frames.
  size_t passedOver() const { return passedOver_; }
  size_t firstPassedOver() const { return firstPassedOver_; }  ///< entry
  const std::set<std::string>& passedOverClasses() const { return passedOverClasses_; }

 private:
  void note(const std::vector<std::string>& classes);

  std::string file_;
  std::unique_ptr<ObjectFile> stream_;
  size_t entry_ = 0;
  std::string defect_;
  bool isAtEnd_ = false;
  size_t passedOver_ = 0, firstPassedOver_ = 0;
  std::set<std::string> passedOverClasses_;
};

}  // namespace hybrid_slam::files
