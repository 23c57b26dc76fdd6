#include "run/Progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace hybrid_slam::run {

Progress::Progress(size_t total, bool isQuiet)
    : total_(std::max<size_t>(total, 1)),
      isQuiet_(isQuiet),
      isTerminal_(isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      last_(start_) {}

void Progress::update(size_t done, const std::string& note) {
  if (isQuiet_) return;
  const auto now = Clock::now();
  const std::chrono::duration<double> sinceLast = now - last_, elapsed = now - start_;
  if (sinceLast.count() < (isTerminal_ ? 0.2 : 10) && (done < total_ || !isTerminal_)) return;
  last_ = now;
  const double share = std::min(1.0, static_cast<double>(done) / static_cast<double>(total_));
  const int left = share > 0 ? static_cast<int>(std::lround(elapsed.count() * (1 - share) / share)) : 0;
  if (!isTerminal_) {
    std::fprintf(stderr, "%zu of %zu scans (%.0f %%), %d s left, %s\n", done, total_, 100 * share, left,
                 note.c_str());
    return;
  }
  constexpr int kWidth = 30;
  const int filled = static_cast<int>(share * kWidth);
  std::fprintf(stderr, "\r[%s%s] %3.0f %%  %d:%02d left  %s\033[K", std::string(filled, '#').c_str(),
               std::string(kWidth - filled, '.').c_str(), 100 * share, left / 60, left % 60, note.c_str());
  hasBar_ = true;
}

void Progress::say(const std::string& line) {
  std::fprintf(stderr, "%s%s\n", hasBar_ ? "\r\033[K" : "", line.c_str());
}

void Progress::finish() {
  if (hasBar_) std::fprintf(stderr, "\n");
  hasBar_ = false;
}

}  // namespace hybrid_slam::run
