#include "slam/lines/SequentialExtraction.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

namespace hybrid_slam {
namespace {

using mrpt::math::TPoint2D;

using Points = std::vector<TPoint2D>;
using Places = std::vector<size_t>;  // of points in a run, ascending

Points pointsAt(PointRange run, const Places& places) {
  Points points;
  points.reserve(places.size());
  for (const size_t i : places) points.push_back(run.first[i]);
  return points;
}

Places placesNear(PointRange run, const Places& places, const FittedLine& line, double near) {
  Places result;
  const IsNear isNear(line, near);
  for (const size_t i : places)
    if (isNear(run.first[i])) result.push_back(i);
  return result;
}

/// Splits places where more than kMostMissing in a row are missing.
std::vector<Places> stretches(const Places& places) {
  std::vector<Places> result;
  for (const size_t i : places) {
    if (result.empty() || i > result.back().back() + kMostMissing + 1) result.emplace_back();
    result.back().push_back(i);
  }
  return result;
}

/// The places on each line of a run that is long enough, in the order in which the lines were found.
std::vector<Places> findLines(PointRange run, const SegmentationOptions& options, LineFinder find) {
  const double near = options.splitDistance / 2;
  const auto least = static_cast<size_t>(options.minPoints);
  const auto isShort = [&](const Places& places) {
    const TPoint2D &a = run.first[places.front()], &b = run.first[places.back()];
    return places.size() < least || std::hypot(b.x - a.x, b.y - a.y) < options.minLength;
  };
  uint64_t key[2];
  std::memcpy(key, run.first, sizeof(key));
  RandomStream random(run.size(), key[0], key[1]);

  std::vector<Places> lines;
  Places rest(run.size());
  std::iota(rest.begin(), rest.end(), 0);
  while (rest.size() >= least) {
    const Points points = pointsAt(run, rest);
    auto line = find({points.data(), points.data() + points.size()}, near, random);
    if (!line) break;
    const Points members = pointsAt(run, placesNear(run, rest, *line, near));
    line = fitOrthogonal({members.data(), members.data() + members.size()});
    if (!line) break;
    Places used = placesNear(run, rest, *line, near);
    if (used.size() < least) break;
    std::vector<Places> found = stretches(used);
    found.erase(std::remove_if(found.begin(), found.end(), isShort), found.end());
    if (!found.empty()) {  // the points between the stretches may belong to lines that cross this one
      used.clear();
      for (const Places& places : found) used.insert(used.end(), places.begin(), places.end());
    }
    lines.insert(lines.end(), found.begin(), found.end());
    Places kept;
    std::set_difference(rest.begin(), rest.end(), used.begin(), used.end(), std::back_inserter(kept));
    rest = std::move(kept);
  }
  return lines;
}

}  // namespace

std::vector<LineSegment> extractSequentially(const LaserScan& scan, const LineExtractionOptions& options,
                                             LineFinder find) {
  const SegmentedScan segmented(scan, options.segmentation);
  std::vector<Points> lines;
  for (const PointRange& run : segmented.runs()) {
    std::vector<Places> places = findLines(run, options.segmentation, find);
    std::sort(places.begin(), places.end());  // in beam order
    for (const Places& line : places) lines.push_back(pointsAt(run, line));
  }
  std::vector<PointRange> pieces;
  for (const Points& line : lines) pieces.push_back({line.data(), line.data() + line.size()});
  return linesOf(pieces, scan, options);
}

std::optional<FittedLine> randomLine(PointRange points, RandomStream& random) {
  const auto any = [&] {
    return points.first[static_cast<size_t>(random.uniform() * static_cast<double>(points.size()))];
  };
  const TPoint2D pair[] = {any(), any()};
  return fitOrthogonal({pair, pair + 2});
}

size_t countNear(PointRange points, const FittedLine& line, double near) {
  return static_cast<size_t>(std::count_if(points.begin(), points.end(), IsNear(line, near)));
}

}  // namespace hybrid_slam
