/// @file RecordingFolder.h
/// @brief The folder of a ROS 2 recording: its files one after another.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bags/Bag.h"

namespace hybrid_slam::bags {

/// The databases and MCAP files in a folder, plain or compressed, in the order of the numbers in their names;
/// only those that metadata.yaml lists, if it lists any of them.
std::vector<std::string> filesOfRecording(const std::string& folder);

/// Reads the files one after another. A file that cannot be opened is a defect, after which nothing is read.
/// One that metadata.yaml lists and that is not there is a defect too.
class RecordingFolder : public Bag {
 public:
  /// @throws InputError if there is no file, or files of several recordings (names that differ in more than
  ///         their last number) that no metadata.yaml lists
  explicit RecordingFolder(const std::string& path);
  /// @throws InputError if the first file cannot be opened
  std::optional<StoredMessage> next() override;
  const char* format() const override { return "ROS 2 recording"; }

 private:
  size_t indexOf(const Topic& topic);

  std::vector<std::string> files_;  ///< still to be read
  std::string missing_;             ///< a file
  std::unique_ptr<Bag> current_;
};

}  // namespace hybrid_slam::bags
