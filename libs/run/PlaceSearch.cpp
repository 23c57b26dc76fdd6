#include "run/PlaceSearch.h"

#include <mrpt/core/bits_math.h>

#include <utility>
#include <vector>

#include "base/Numbers.h"
#include "run/PlanFiles.h"
#include "run/Verdict.h"
#include "run/VerdictCheck.h"
#include "slam/loops/RevisitCheck.h"

namespace hybrid_slam::run {
namespace {

std::string placeText(const mrpt::math::TPose2D& pose, size_t scans) {
  return "place found after " + counted(scans, "scan(s): (") + fixedText(pose.x, 2) + ", " +
         fixedText(pose.y, 2) + ") m, " + fixedText(mrpt::RAD2DEG(pose.phi), 1) + " deg in ";
}

}  // namespace

PlaceSearch::PlaceSearch(const Configuration& configuration, std::optional<ScanMap> earlierMap)
    : run_(configuration.run), earlierMap_(std::move(earlierMap)) {
  if (earlierMap_)
    localizer_ =
        std::make_unique<Localizer>(configuration.filter, earlierMap_->grid, earlierMap_->lines, run_.start);
  else
    plan_ = std::make_unique<PlanSearch>(configuration.filter, loadPlan(run_.priorPlan), run_.start);
}

std::string PlaceSearch::warning() const {
  if (!earlierMap_ || run_.start || earlierMap_->grid.resolution() <= RevisitCheck::kResolution) return {};
  return "the place in " + run_.continueFrom + " is not checked: its cells are larger than " +
         fixedText(RevisitCheck::kResolution, 1) + " m";
}

std::optional<FoundPlace> PlaceSearch::process(const readings::Reading& reading, const HybridFilter& filter,
                                               size_t scans) {
  return plan_ ? findInPlan(reading, scans) : findInMap(reading, filter, scans);
}

std::optional<FoundPlace> PlaceSearch::findInMap(const readings::Reading& reading, const HybridFilter& filter,
                                                 size_t scans) {
  constexpr size_t kPause = 20;  // scans
  const size_t before = localizer_->updates();
  localizer_->process(reading.motion, reading.scans);
  const bool isUpdate = localizer_->updates() > before;  // else its pose is that of an earlier scan
  if (!isUpdate || !localizer_->isLocalized() || scans < nextPlace_) return {};
  const mrpt::math::TPose2D pose = localizer_->bestPath().back();
  if (!run_.start && isContradictedAt(pose, filter)) {
    nextPlace_ = scans + kPause;
    return {};
  }
  isOver_ = true;
  return FoundPlace{*earlierMap_, pose, placeText(pose, scans) + "the map of " + run_.continueFrom};
}

// A corridor of another building may look like one of the map. Then the scans on the way there contradict it.
bool PlaceSearch::isContradictedAt(const mrpt::math::TPose2D& pose, const HybridFilter& filter) {
  if (!walls_) walls_ = toCompare(earlierMap_->grid);
  const std::vector<Revisit> compared = filter.comparedWith(*walls_, pose);
  return static_cast<double>(contradictedOf(compared)) >
         kMostAgainstEarlierMap * static_cast<double>(compared.size());
}

std::optional<FoundPlace> PlaceSearch::findInPlan(const readings::Reading& reading, size_t scans) {
  plan_->process(reading.motion, reading.scans);
  isOver_ = plan_->isOver();
  const auto& found = plan_->found();
  if (!found) return {};
  return FoundPlace{
      found->map, found->pose,
      placeText(found->pose, scans) + run_.priorPlan + ", scaled by " + fixedText(found->scale, 3)};
}

}  // namespace hybrid_slam::run
