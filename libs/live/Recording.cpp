#include "live/Recording.h"

#include <exception>

#include "base/Errors.h"

namespace hybrid_slam::live {

Recording::Recording(const std::string& path, EventLog& log)
    : path_(path), log_(log), writer_(std::make_unique<files::RawlogWriter>(path)) {}

void Recording::write(const mrpt::obs::CObservation& observation) {
  if (!writer_) return;
  try {
    writer_->write(observation);
    if (Clock::now() - lastFlush_ >= std::chrono::seconds(5)) flush();
  } catch (const std::exception& e) {
    endAt(e);
  }
}

void Recording::flush() {
  writer_->flush();
  lastFlush_ = Clock::now();
}

void Recording::finish() {
  if (!writer_) return;
  try {
    writer_->finish();
    writer_.reset();
  } catch (const std::exception& e) {
    endAt(e);
  }
}

void Recording::endAt(const std::exception& fault) {
  log_.report("recording", "stopped; the run continues (" + messageOf(fault) + ")");
  try {
    writer_->finishCut();
  } catch (const std::exception&) {  // the folder is gone
  }
  writer_.reset();
}

}  // namespace hybrid_slam::live
