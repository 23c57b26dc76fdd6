#include "live/Recording.h"

#include <fcntl.h>
#include <unistd.h>

#include <exception>
#include <filesystem>

#include "base/Errors.h"
#include "base/Numbers.h"
#include "files/DatedName.h"
#include "files/Locks.h"

namespace hybrid_slam::live {

Recording::Recording(const std::string& folder, const std::string& name, EventLog& log)
    : folder_(folder),
      name_(name),
      place_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)),
      log_(log) {}

Recording::~Recording() {
  finish();
  if (place_ >= 0) ::close(place_);
}

std::string Recording::path() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return path_;
}

/// Returns where the folder is now; where it was, if it was removed.
std::string Recording::folder() const {
  const std::string moved = place_ < 0 || files::isNamed(place_, folder_) ? folder_ : files::pathOf(place_);
  return moved.empty() ? folder_ : moved;
}

void Recording::open() {
  namespace fs = std::filesystem;
  const fs::path stem = fs::path(name_).stem(), extension = fs::path(name_).extension();
  const std::string folder = Recording::folder();
  std::error_code ignored;
  fs::create_directories(folder, ignored);  // it may have been removed
  files::claimDatedName([&](const std::string& date) {
    path_ = (fs::path(folder) / (stem.string() + "-" + date + extension.string())).string();
    writer_ = std::make_unique<files::RawlogWriter>(path_);
    const bool isFree =
        writer_->isOnly() && !fs::exists(path_);  // looked at now: another may just have ended
    if (!isFree) writer_.reset();
    return isFree;
  });
}

void Recording::write(const mrpt::obs::CObservation& observation) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (entries_++ == 0) open();
  if (!writer_) return;
  if (isDiskAlmostFull()) {
    log_.report("recording", "stopped; the run continues (disk almost full: " + folder() + "; expected " +
                                 fixedText(reserve_ / 1e6, 0) +
                                 " MB of free disk space for the results, [live] disk_reserve)");
    return end();
  }
  try {
    writer_->write(observation);
  } catch (const std::exception& e) {
    endAt(e);
  }
  if (Clock::now() - lastFlush_ >= std::chrono::seconds(5)) sync();
}

// Who sends the observations decides how many there are; the results must still find space.
bool Recording::isDiskAlmostFull() const {
  std::error_code unknown;  // then `available` is the largest number
  return static_cast<double>(std::filesystem::space(folder(), unknown).available) < reserve_;
}

void Recording::flush() {
  const std::lock_guard<std::mutex> lock(mutex_);
  sync();
}

void Recording::sync() {
  if (!writer_) return;
  try {
    writer_->flush();
  } catch (const std::exception& e) {
    endAt(e);
  }
  lastFlush_ = Clock::now();
}

void Recording::finish() {
  const std::lock_guard<std::mutex> lock(mutex_);
  end();
}

void Recording::end() {
  if (!writer_) return;
  try {
    writer_->finish();
    path_ = writer_->path();
    writer_.reset();
  } catch (const std::exception& e) {
    endAt(e);
  }
}

void Recording::endAt(const std::exception& fault) {
  log_.report("recording", "stopped; the run continues (" + messageOf(fault) + ")");
  try {
    writer_->finishCut();
    path_ = writer_->path();
  } catch (const std::exception&) {  // the folder is gone
  }
  writer_.reset();
}

}  // namespace hybrid_slam::live
