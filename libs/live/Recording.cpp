#include "live/Recording.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <exception>
#include <filesystem>

#include "base/Errors.h"
#include "base/Numbers.h"
#include "files/DatedName.h"

namespace hybrid_slam::live {

Recording::Recording(const std::string& folder, const std::string& name, EventLog& log)
    : folder_(folder), name_(name), log_(log) {}

void Recording::open() {
  namespace fs = std::filesystem;
  const fs::path stem = fs::path(name_).stem(), extension = fs::path(name_).extension();
  files::claimDatedName([&](const std::string& date) {
    path_ = (fs::path(folder_) / (stem.string() + "-" + date + extension.string())).string();
    const std::string partial = files::PartialFile::partialName(path_);
    const int file = ::open(partial.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (file < 0 && errno != EEXIST)
      throw InputError(
          "cannot write", path_,
          std::string("expected a writable folder with free disk space: ") + std::strerror(errno));
    if (file < 0) return false;
    ::close(file);
    const bool isFree = !fs::exists(path_);  // looked at now, as another recording may just have ended
    if (!isFree) fs::remove(partial);
    return isFree;
  });
  writer_ = std::make_unique<files::RawlogWriter>(path_);
}

void Recording::write(const mrpt::obs::CObservation& observation) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (entries_++ == 0) open();
  if (!writer_) return;
  if (isDiskAlmostFull()) {
    log_.report("recording", "stopped; the run continues (disk almost full: " + folder_ + "; expected " +
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
  return static_cast<double>(std::filesystem::space(folder_, unknown).available) < reserve_;
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
