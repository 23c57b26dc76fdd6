/// @file TestBags.h
/// @brief For the tests: ROS messages as bytes, and recordings of ROS 2.
#pragma once

#include <lz4frame.h>
#include <mrpt/core/Clock.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <sqlite3.h>
#include <zlib.h>
#include <zstd.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bags/Messages.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::test {

using bags::Encoding;

/// The bytes of a message.
class MessageBytes {
 public:
  explicit MessageBytes(Encoding encoding, bool isBigEndian = false)
      : isCdr_(encoding == Encoding::cdr), isBigEndian_(isBigEndian) {
    if (isCdr_) bytes_ = std::string{'\0', isBigEndian ? '\0' : '\1', '\0', '\0'};
  }
  template <class Number>
  MessageBytes& add(Number value) {
    while (isCdr_ && (bytes_.size() - 4) % sizeof(Number) != 0) bytes_ += '\0';
    const char* const raw = reinterpret_cast<const char*>(&value);
    for (size_t i = 0; i < sizeof(Number); ++i) bytes_ += raw[isBigEndian_ ? sizeof(Number) - 1 - i : i];
    return *this;
  }
  MessageBytes& string(const std::string& text) {
    add(static_cast<uint32_t>(text.size() + (isCdr_ ? 1 : 0)));
    bytes_ += text;
    if (isCdr_) bytes_ += '\0';
    return *this;
  }
  MessageBytes& header(double time, const std::string& frame) {
    if (!isCdr_) add(uint32_t{7});
    add(static_cast<uint32_t>(time)).add(static_cast<uint32_t>(std::lround((time - std::floor(time)) * 1e9)));
    return string(frame);
  }
  MessageBytes& floats(const std::vector<float>& values) {
    add(static_cast<uint32_t>(values.size()));
    for (const float value : values) add(value);
    return *this;
  }
  MessageBytes& doubles(const std::vector<double>& values) {
    for (const double value : values) add(value);
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  bool isCdr_, isBigEndian_;
  std::string bytes_;
};

inline MessageBytes scanHead(MessageBytes out, double time, const std::string& frame, float angleMin,
                             float step, float timeStep = 0) {
  out.header(time, frame).add(angleMin).add(angleMin + 100 * step).add(step);
  return out.add(timeStep).add(0.1f).add(0.2f).add(20.f);  // time_increment, scan_time, range_min, range_max
}

inline std::string scanBytes(MessageBytes out, double time, const std::string& frame,
                             const std::vector<float>& ranges, float angleMin = -1, float step = 0.5f,
                             float timeStep = 0) {
  return scanHead(std::move(out), time, frame, angleMin, step, timeStep)
      .floats(ranges)
      .floats({1, 2, 3})
      .bytes();
}

/// A sensor_msgs/MultiEchoLaserScan. @param echoes  m, of each beam
inline std::string echoesBytes(const MessageBytes& empty, double time, const std::string& frame,
                               const std::vector<std::vector<float>>& echoes, float angleMin = -1,
                               float step = 0.5f) {
  MessageBytes out = scanHead(empty, time, frame, angleMin, step);
  out.add(static_cast<uint32_t>(echoes.size()));
  for (const std::vector<float>& beam : echoes) out.floats(beam);
  return out.add(uint32_t{1}).floats({7, 8}).bytes();  // intensities
}

inline std::string odometryBytes(MessageBytes out, double time, const TPose2D& pose,
                                 const std::string& child = "base_link") {
  out.header(time, "odom").string(child);
  out.doubles({pose.x, pose.y, 0, 0, 0, std::sin(pose.phi / 2), std::cos(pose.phi / 2)});
  return out.doubles(std::vector<double>(36 + 6 + 36, 0.5)).bytes();
}

struct Transform {
  std::string parent, child;
  std::vector<double> pose;  ///< x, y, z, qx, qy, qz, qw
};

inline std::string transformBytes(MessageBytes out, double time, const std::vector<Transform>& transforms) {
  out.add(static_cast<uint32_t>(transforms.size()));
  for (const Transform& one : transforms) out.header(time, one.parent).string(one.child).doubles(one.pose);
  return out.bytes();
}

inline std::vector<double> turned(double x, double y, double phi) {
  return {x, y, 0.3, 0, 0, std::sin(phi / 2), std::cos(phi / 2)};
}

struct TestMessage {
  std::string topic, type;  ///< as in ROS 1
  double time;              ///< s, of recording
  std::string bytes;
};

/// Converts the objects of a rawlog to messages: laser on /scan, at the pose of the base.
/// @param timeStep  s, from beam to beam
inline std::vector<TestMessage> messagesOf(const Log& log, Encoding encoding, float timeStep = 0) {
  const MessageBytes empty(encoding);
  std::vector<TestMessage> all;
  for (const auto& object : log) {
    if (const auto odometry = std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(object)) {
      const double time = mrpt::Clock::toDouble(odometry->timestamp);
      all.push_back(
          {"/odom", "nav_msgs/Odometry", time, odometryBytes(empty, time, odometry->odometry.asTPose())});
    } else if (const auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(object)) {
      const double time = mrpt::Clock::toDouble(scan->timestamp);
      std::vector<float> ranges(scan->getScanSize());
      for (size_t i = 0; i < ranges.size(); ++i)
        ranges[i] =
            scan->getScanRangeValidity(i) ? scan->getScanRange(i) : std::numeric_limits<float>::infinity();
      const float step = scan->aperture / static_cast<float>(ranges.size() - 1);
      all.push_back({"/scan", "sensor_msgs/LaserScan", time,
                     scanBytes(empty, time, "base_link", ranges, -scan->aperture / 2, step, timeStep)});
    }
  }
  return all;
}

inline std::string typeInRos2(const std::string& type) {
  const size_t slash = type.find('/');
  return slash == std::string::npos ? type : type.substr(0, slash) + "/msg" + type.substr(slash);
}

inline std::string zstdOf(const std::string& bytes) {
  std::string out(ZSTD_compressBound(bytes.size()), '\0');
  out.resize(ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), 1));
  return out;
}

inline std::string lz4Of(const std::string& bytes) {
  std::string out(LZ4F_compressFrameBound(bytes.size(), nullptr), '\0');
  out.resize(LZ4F_compressFrame(out.data(), out.size(), bytes.data(), bytes.size(), nullptr));
  return out;
}

inline std::string write(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

/// Makes the bytes of an MCAP file.
class McapBytes {
 public:
  explicit McapBytes(Encoding encoding) : encoding_(encoding) {
    record(1, plain().string("ros2").string("test").bytes());
  }
  /// @param compression  of a chunk: `zstd`, `lz4`, or empty; `none`: no chunk
  void add(const std::vector<TestMessage>& messages, const std::string& compression) {
    McapBytes chunk(*this, "");
    for (const TestMessage& message : messages) chunk.add(message);
    channels_ = chunk.channels_;
    if (compression == "none") {
      bytes_ += chunk.bytes_;
      return;
    }
    const std::string& from = chunk.bytes_;
    const std::string packed = compression == "zstd"  ? zstdOf(from)
                               : compression == "lz4" ? lz4Of(from)
                                                      : from;
    const auto sum = static_cast<uint32_t>(
        crc32(0, reinterpret_cast<const Bytef*>(from.data()), static_cast<uInt>(from.size())));
    record(6, plain().add(uint64_t{0})
                      .add(uint64_t{0})
                      .add(uint64_t{from.size()})
                      .add(sum)
                      .string(compression)
                      .add(uint64_t{packed.size()})
                      .bytes() +
                  packed);
    record(7, std::string(10, '\0'));
  }
  std::string finished() {
    const std::string magic = "\x89MCAP0\r\n";
    const std::string data = magic + bytes_;
    const auto sum = static_cast<uint32_t>(
        crc32(0, reinterpret_cast<const Bytef*>(data.data()), static_cast<uInt>(data.size())));
    record(15, plain().add(sum).bytes());
    record(2, std::string(20, '\0'));
    return magic + bytes_ + magic;
  }
  std::string unfinished() const { return "\x89MCAP0\r\n" + bytes_; }

 private:
  McapBytes(const McapBytes& other, const std::string& bytes)
      : encoding_(other.encoding_), channels_(other.channels_), bytes_(bytes) {}
  static MessageBytes plain() { return MessageBytes(Encoding::ros1); }
  void record(char kind, const std::string& content) {
    bytes_ += kind + plain().add(uint64_t{content.size()}).bytes() + content;
  }
  void add(const TestMessage& message) {
    const bool isCdr = encoding_ == Encoding::cdr;
    const auto next = static_cast<uint16_t>(channels_.size() + 1);
    const auto [channel, isNew] = channels_.try_emplace(message.topic, next);
    if (isNew) {
      const std::string type = isCdr ? typeInRos2(message.type) : message.type;
      record(3, plain().add(next).string(type).string("ros2msg").string("text").bytes());
      record(4, plain()
                    .add(next)
                    .add(next)
                    .string(message.topic)
                    .string(isCdr ? "cdr" : "ros1")
                    .string("")
                    .bytes());
    }
    const auto time = static_cast<uint64_t>(std::llround(message.time * 1e9));
    record(5, plain().add(channel->second).add(uint32_t{0}).add(time).add(time).bytes() + message.bytes);
  }

  Encoding encoding_;
  std::map<std::string, uint16_t> channels_;
  std::string bytes_;
};

/// Writes an MCAP file with chunks of 10 messages.
inline std::string writeMcap(const std::string& path, const std::vector<TestMessage>& messages,
                             const std::string& compression = "zstd", Encoding encoding = Encoding::cdr) {
  McapBytes file(encoding);
  for (size_t i = 0; i < messages.size(); i += 10)
    file.add({messages.begin() + static_cast<std::ptrdiff_t>(i),
              messages.begin() + static_cast<std::ptrdiff_t>(std::min(i + 10, messages.size()))},
             compression);
  return write(path, file.finished());
}

/// Writes a ROS 2 database.
inline std::string writeDatabase(const std::string& path, const std::vector<TestMessage>& messages) {
  std::remove(path.c_str());
  sqlite3* database = nullptr;
  sqlite3_open(path.c_str(), &database);
  const auto run = [&](const std::string& sql) {
    sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr);
  };
  run("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
      "serialization_format "
      "TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)");
  run("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, "
      "data "
      "BLOB NOT NULL)");
  run("CREATE INDEX timestamp_idx ON messages (timestamp ASC); BEGIN");
  std::map<std::string, size_t> topics;
  sqlite3_stmt* insert = nullptr;
  sqlite3_prepare_v2(database, "INSERT INTO messages(topic_id, timestamp, data) VALUES (?, ?, ?)", -1,
                     &insert, nullptr);
  for (const TestMessage& message : messages) {
    const auto [topic, isNew] = topics.try_emplace(message.topic, topics.size() + 1);
    if (isNew)
      run("INSERT INTO topics VALUES (" + std::to_string(topic->second) + ", '" + message.topic + "', '" +
          typeInRos2(message.type) + "', 'cdr', '')");
    sqlite3_bind_int64(insert, 1, static_cast<int64_t>(topic->second));
    sqlite3_bind_int64(insert, 2, std::llround(message.time * 1e9));
    sqlite3_bind_blob(insert, 3, message.bytes.data(), static_cast<int>(message.bytes.size()),
                      SQLITE_TRANSIENT);
    sqlite3_step(insert);
    sqlite3_reset(insert);
  }
  sqlite3_finalize(insert);
  run("COMMIT");
  sqlite3_close(database);
  return path;
}

}  // namespace hybrid_slam::test
