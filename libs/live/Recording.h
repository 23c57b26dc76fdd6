/// @file Recording.h
/// @brief Records the raw observations of a live run as a rawlog, robust to crashes.
#pragma once

#include <mrpt/obs/CObservation.h>

#include <chrono>
#include <memory>
#include <string>

#include "files/RawlogWriter.h"
#include "live/EventLog.h"

namespace hybrid_slam::live {

/// The file is `.partial.NAME` while it grows and is synced to disk every 5 s. It gets its final name at the
/// end of the run, even a failed one. After a power cut the partial file is readable up to its end.
class Recording {
 public:
  /// @throws InputError if it cannot be written
  Recording(const std::string& path, EventLog& log);
  ~Recording() { finish(); }
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  /// A full disk ends the recording, not the run, and is reported.
  void write(const mrpt::obs::CObservation& observation);
  /// Syncs everything written so far to disk.
  void flush();
  void finish();
  const std::string& path() const { return path_; }

 private:
  using Clock = std::chrono::steady_clock;
  void endAt(const std::exception& fault);

  std::string path_;
  EventLog& log_;
  std::unique_ptr<files::RawlogWriter> writer_;  ///< null after the end
  Clock::time_point lastFlush_ = Clock::now();
};

}  // namespace hybrid_slam::live
