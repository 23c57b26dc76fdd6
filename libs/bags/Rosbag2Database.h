/// @file Rosbag2Database.h
/// @brief ROS 2 recordings in SQLite databases (`.db3`).
#pragma once

#include <memory>
#include <string>
#include <unordered_map>

#include "bags/Bag.h"

struct sqlite3;
struct sqlite3_stmt;

namespace hybrid_slam::bags {

/// SQLite trusts nothing in the file: no views, triggers, virtual tables, computed columns or functions of
/// the file's own, and no value over 256 MiB. Pages that refer to each other yield no more bytes than
/// the file has.
class Rosbag2Database : public Bag {
 public:
  /// @throws InputError if the file cannot be read, or is not a recording
  explicit Rosbag2Database(const std::string& path);
  ~Rosbag2Database() override;
  std::optional<StoredMessage> next() override;
  const char* format() const override { return "ROS 2 database"; }

 private:
  /// @throws InputError if this is not a table, or has computed columns
  void checkTable(const std::string& name, const std::string& path);
  void readTopics(const std::string& path);
  std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> query(const std::string& sql);

  std::unique_ptr<sqlite3, int (*)(sqlite3*)> database_;
  std::unordered_map<int64_t, size_t> ids_;  ///< topic of each
  int64_t bytesLeft_ = 0;                    ///< upper limit for the messages still to be read
  std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> messages_;
};

}  // namespace hybrid_slam::bags
