/// @file Recording.h
/// @brief Records the raw observations of a live run as a rawlog, robust to crashes.
#pragma once

#include <mrpt/obs/CObservation.h>

#include <chrono>
#include <memory>
#include <mutex>
#include <string>

#include "files/RawlogWriter.h"
#include "live/EventLog.h"

namespace hybrid_slam::live {

/// The file is opened at the first observation, with the date and time in its name, so that it never replaces
/// another. It is `.partial.NAME` while it grows and is synced to disk every 5 s. It gets its final name at
/// the end of the run, even a failed one. After a power cut the partial file is readable up to its end.
class Recording {
 public:
  /// @param name  file name; the date and time are inserted before its extension
  Recording(const std::string& folder, const std::string& name, EventLog& log);
  ~Recording();
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  /// Sets the disk space (bytes) that the recording leaves free for the results; 1 GB by default.
  void keepFree(double bytes) { reserve_ = bytes; }
  /// A disk that is full, up to the reserve, ends the recording, not the run, and is reported.
  /// @throws InputError if the file cannot be opened
  void write(const mrpt::obs::CObservation& observation);
  /// Syncs everything written so far to disk, from any thread.
  void flush();
  void finish();
  /// Returns the path; empty before the first observation.
  std::string path() const;
  size_t entries() const { return entries_; }  ///< observations taken, even if they could not be written

 private:
  using Clock = std::chrono::steady_clock;
  void open();
  std::string folder() const;
  void sync();
  bool isDiskAlmostFull() const;
  void end();
  void endAt(const std::exception& fault);

  std::string folder_, name_;
  int place_;  ///< the open folder, which may be moved
  size_t entries_ = 0;
  double reserve_ = 1e9;  ///< bytes
  EventLog& log_;
  mutable std::mutex mutex_;  ///< guards the next three
  std::string path_;
  std::unique_ptr<files::RawlogWriter> writer_;  ///< null before the first observation and after the end
  Clock::time_point lastFlush_ = Clock::now();
};

}  // namespace hybrid_slam::live
