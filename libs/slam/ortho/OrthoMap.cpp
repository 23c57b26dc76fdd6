#include "slam/ortho/OrthoMap.h"

#include <algorithm>
#include <cmath>

#include "base/PoseRotation.h"
#include "slam/lines/WallDirections.h"

namespace hybrid_slam {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace {

double squared(double value) { return value * value; }

double totalLength(const std::vector<SeenOrthoLine>& lines) {
  double sum = 0;
  for (const SeenOrthoLine& line : lines) sum += line.length;
  return sum;
}

}  // namespace

OrthoMap::OrthoMap(const OrthoOptions& options, const LineDatabaseOptions& pruning)
    : options_(options), pruning_(pruning) {}

void OrthoMap::update(const std::vector<LineSegment>& seen) {
  ++updates_;
  matched_ = 0;
  if (!direction_) findDirection(seen);
  if (!direction_) return;
  correctHeading(seen);
  for (const SeenOrthoLine& line : parallels(seen)) correctOrInsert(line);
  if (updates_ % pruning_.pruneInterval == 0) prune();
}

// The first scan most of whose walls are at right angles gives the frame.
void OrthoMap::findDirection(const std::vector<LineSegment>& seen) {
  const auto direction = directionModuloRightAngle(seen);
  if (!direction) return;
  double all = 0;
  for (const LineSegment& line : seen) all += line.length;
  if (totalLength(orthogonalLines(seen, -*direction, options_.maxAngle)) < 0.5 * all) return;
  direction_ = wrapToRightAngle(state_.pose().phi + *direction);
  state_.turnFrame(*direction_, squared(options_.sigmaAngle));
}

std::vector<SeenOrthoLine> OrthoMap::parallels(const std::vector<LineSegment>& seen) const {
  const double sigma = std::sqrt(state_.poseCovariance()(2, 2) + squared(options_.sigmaAngle));
  return orthogonalLines(seen, state_.pose().phi, std::min(options_.maxAngle, options_.gate * sigma));
}

// One measurement for all lines: their errors are those of the building, and common to them.
void OrthoMap::correctHeading(const std::vector<LineSegment>& seen) {
  const auto lines = parallels(seen);
  const double total = totalLength(lines);
  if (total <= 0) return;
  double mean = 0;
  for (const SeenOrthoLine& line : lines) mean += line.length / total * line.deviation;
  OrthoState::Measurement heading = state_.measurement(-mean, squared(options_.sigmaAngle));
  heading.byState[2] = 1;
  state_.correct(heading);
}

void OrthoMap::correctOrInsert(const SeenOrthoLine& seen) {
  const PlacedLine placed(seen, state_.pose());
  const double variance = squared(options_.sigmaOffset);
  if (const auto match = associate(seen, placed, lines_, state_, options_)) {
    state_.correct(measurementOf(placed, *match, state_, variance));
    OrthoLine& line = lines_[*match];
    line.low = std::min(line.low, placed.low);
    line.high = std::max(line.high, placed.high);
    ++line.count;
    ++matched_;
    joinPieces(*match);
  } else if (seen.length >= options_.minLength) {
    state_.add(placed.offset, placed.byPose, variance);
    lines_.push_back({seen.side, placed.low, placed.high, 1, updates_});
  }
}

// A line that has grown may have reached another piece of its wall.
void OrthoMap::joinPieces(size_t line) {
  for (size_t other = lines_.size(); other-- > 0;) {
    OrthoLine& whole = lines_[line];
    const OrthoLine& piece = lines_[other];
    if (other == line || piece.side != whole.side || !areNear(piece.low, piece.high, whole, 0)) continue;
    OrthoState::Measurement difference =
        state_.measurement(state_.offset(other) - state_.offset(line), squared(options_.sigmaOffset));
    difference.byState[OrthoState::index(line)] = 1;
    difference.byState[OrthoState::index(other)] = -1;
    if (state_.squaredDistance(difference) > squared(options_.gate)) continue;
    state_.correct(difference);
    whole.low = std::min(whole.low, piece.low);
    whole.high = std::max(whole.high, piece.high);
    whole.count += piece.count;
    whole.inserted = std::min(whole.inserted, piece.inserted);
    remove(other);
    if (other < line) --line;
  }
}

void OrthoMap::prune() {
  for (size_t i = lines_.size(); i-- > 0;)
    if (lines_[i].count < pruning_.minCount && updates_ - lines_[i].inserted >= pruning_.pruneInterval)
      remove(i);
}

void OrthoMap::remove(size_t line) {
  state_.remove(line);
  lines_.erase(lines_.begin() + static_cast<std::ptrdiff_t>(line));
}

TPose2D OrthoMap::pose() const { return TPose2D(0, 0, direction_.value_or(0)) + state_.pose(); }

Eigen::Matrix3d OrthoMap::poseCovariance() const {
  return rotated(state_.poseCovariance(), direction_.value_or(0));
}

std::vector<DatabaseLine> OrthoMap::lines() const {
  const TPose2D frame(0, 0, direction_.value_or(0));
  std::vector<DatabaseLine> all;
  for (size_t i = 0; i < lines_.size(); ++i) {
    const OrthoLine& line = lines_[i];
    const double c = state_.offset(i);
    const bool isAcrossX = line.isAcrossX();
    const TPoint2D start = isAcrossX ? TPoint2D(c, line.low) : TPoint2D(line.low, c);
    const TPoint2D end = isAcrossX ? TPoint2D(c, line.high) : TPoint2D(line.high, c);
    all.push_back({transformed(makeSegment(start, end), frame), line.count, line.inserted, frame.phi});
  }
  return all;
}

}  // namespace hybrid_slam
