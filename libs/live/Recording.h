/// @file Recording.h
/// @brief The raw observations of a live run as a rawlog, whatever happens to the run.
#pragma once

#include <mrpt/obs/CObservation.h>

#include <chrono>
#include <memory>
#include <string>

#include "files/RawlogWriter.h"
#include "live/EventLog.h"

namespace hybrid_slam::live {

/// While it grows the file is `.partial.NAME`; every 5 s all of it is on disk. It gets its name at the end of
/// the run, also of one that failed; after a power cut the partial file can be read up to where it ends.
class Recording {
 public:
  /// @throws InputError if it cannot be written there
  Recording(const std::string& path, EventLog& log);
  ~Recording() { finish(); }
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  /// A disk that takes no more ends the recording, not the run; it is reported.
  void write(const mrpt::obs::CObservation& observation);
  /// All that was written is on disk after this.
  void flush();
  void finish();
  const std::string& path() const { return path_; }

 private:
  using Clock = std::chrono::steady_clock;
  void endAt(const std::exception& fault);

  std::string path_;
  EventLog& log_;
  std::unique_ptr<files::RawlogWriter> writer_;  ///< null once it has ended
  Clock::time_point lastFlush_ = Clock::now();
};

}  // namespace hybrid_slam::live
