#include "window/view/Checkpoints.h"

#include <utility>

namespace hybrid_slam::window {

size_t Checkpoint::bytes() const {
  size_t sum = 0;
  for (const Lane& lane : lanes) sum += lane.run.size();
  return sum;
}

bool Checkpoints::isDue(size_t scans) const {
  return scans > 0 && scans % every_ == 0 && all_.count(scans) == 0;
}

void Checkpoints::add(size_t scans, Checkpoint checkpoint) {
  bytes_ += checkpoint.bytes();
  all_.emplace(scans, std::move(checkpoint));
  while (bytes_ > mostBytes_ && all_.size() > 1) {
    every_ *= 2;
    for (auto at = all_.begin(); at != all_.end();) {
      if (at->first % every_ == 0) {
        ++at;
        continue;
      }
      bytes_ -= at->second.bytes();
      at = all_.erase(at);
    }
  }
}

const std::pair<const size_t, Checkpoint>* Checkpoints::upTo(size_t scans) const {
  const auto after = all_.upper_bound(scans);
  return after == all_.begin() ? nullptr : &*std::prev(after);
}

}  // namespace hybrid_slam::window
