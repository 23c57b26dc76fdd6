// The state of the filter: the templates of State.h are instantiated only here.
#include "base/ScanState.h"
#include "slam/filter/HybridFilter.h"

namespace hybrid_slam {

template <class State>
void HybridFilter::visit(State& state) {
  state(particles_, odometry_, updates_, hasMap_, remembersScans_, loopCloser_, base_, known_, updateScans_);
  bool isWhole = !base_ || base_->grid.resolution() == resolution_;
  isWhole = isWhole && updateScans_.size() == (remembersScans_ ? updates_ : 0) &&
            loopCloser_.updates() == (closesLoops_ ? updates_ : 0) && particles_.arePathsOf(updates_ + 1);
  for (const Scans& scans : updateScans_)
    for (const auto& scan : scans) isWhole = isWhole && scan;
  for (const PosedScans& posed : known_)
    for (const auto& scan : posed.scans) isWhole = isWhole && scan;
  state.check(isWhole, "its parts do not belong together");
}

void HybridFilter::save(StateWriter& out) { visit(out); }
void HybridFilter::load(StateReader& in) { visit(in); }

}  // namespace hybrid_slam
