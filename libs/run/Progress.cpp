#include "run/Progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "base/Terminal.h"

namespace hybrid_slam::run {

Progress::Progress(size_t total, bool isQuiet)
    : total_(std::max<size_t>(total, 1)),
      timeLeft_(total_),
      isQuiet_(isQuiet),
      isTerminal_(isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      last_(start_) {}

void Progress::beginAt(size_t done) {
  first_ = std::min(done, total_);
  timeLeft_ = TimeLeft(total_ - first_);
  start_ = Clock::now();
}

void Progress::update(size_t done, const std::string& note) {
  if (isQuiet_) return;
  const auto now = Clock::now();
  const std::chrono::duration<double> sinceLast = now - last_, elapsed = now - start_;
  const std::optional<double> seconds = timeLeft_.after(done - first_, elapsed.count());
  if (sinceLast.count() < (isTerminal_ ? 0.2 : 10) && (done < total_ || !isTerminal_)) return;
  last_ = now;
  const double share = std::min(1.0, static_cast<double>(done) / static_cast<double>(total_));
  const int left = static_cast<int>(std::lround(seconds.value_or(0)));
  if (!isTerminal_) {
    const std::string time = seconds ? std::to_string(left) + " s left, " : "";
    std::fprintf(stderr, "%zu of %zu scans (%.0f %%), %s%s\n", done, total_, 100 * share, time.c_str(),
                 note.c_str());
    return;
  }
  char time[32] = "-:--";
  if (seconds) std::snprintf(time, sizeof time, "%d:%02d", left / 60, left % 60);
  constexpr int kWidth = 30;
  const int filled = static_cast<int>(share * kWidth);
  std::fprintf(stderr, "\r[%s%s] %3.0f %%  %s left  %s\033[K", std::string(filled, '#').c_str(),
               std::string(kWidth - filled, '.').c_str(), 100 * share, time, note.c_str());
  hasBar_ = true;
}

void Progress::say(const std::string& line) {
  std::fprintf(stderr, "%s%s\n", hasBar_ ? "\r\033[K" : "", onOneLine(line).c_str());
}

void Progress::finish() {
  if (hasBar_) std::fprintf(stderr, "\n");
  hasBar_ = false;
}

}  // namespace hybrid_slam::run
