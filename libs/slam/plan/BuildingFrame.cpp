#include "slam/plan/BuildingFrame.h"

#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "slam/lines/WallDirections.h"

namespace hybrid_slam {
namespace {

constexpr double kWindow = mrpt::DEG2RAD(1.5);  // rad: of the walls of one wing
constexpr double kLeastShare = 0.06, kLeastLength = 5;
constexpr size_t kMostDirections = 6;

struct Direction {
  double angle, variance, length;
  bool isUsed = false;
};

double lengthOf(const WallLine& line) {
  double sum = 0;
  for (const Face& face : line.faces) sum += face.length();
  return sum;
}

}  // namespace

std::vector<BuildingDirection> buildingDirections(const std::vector<WallLine>& lines) {
  std::vector<Direction> all;
  double total = 0;
  for (const WallLine& line : lines) {
    const double length = lengthOf(line);
    total += length;
    all.push_back({wrapToRightAngle(line.line.angle), line.line.covariance(1, 1), length});
  }
  constexpr size_t kBins = 360;  // of 0.25 deg
  std::vector<BuildingDirection> found;
  while (found.size() < kMostDirections) {
    std::vector<double> histogram(kBins, 0);
    for (const Direction& d : all)
      if (!d.isUsed)
        histogram[static_cast<size_t>((d.angle + M_PI / 4) / (M_PI / 2) * kBins) % kBins] += d.length;
    double most = 0;
    size_t at = 0;
    for (size_t i = 0; i < kBins; ++i) {
      double sum = 0;
      for (size_t j = 0; j < 6; ++j) sum += histogram[(i + j) % kBins];
      if (sum > most) most = sum, at = i;
    }
    if (most < kLeastLength || most < kLeastShare * total) break;
    double angle = wrapToRightAngle((static_cast<double>(at) + 3) / kBins * M_PI / 2 - M_PI / 4);
    double information = 0, deviation = 0;
    for (int pass = 0; pass < 3; ++pass) {
      double sum = 0, squares = 0;
      information = 0;
      for (const Direction& d : all) {
        const double difference = wrapToRightAngle(d.angle - angle);
        if (d.isUsed || std::abs(difference) > kWindow) continue;
        information += 1 / d.variance;
        sum += difference / d.variance;
        squares += difference * difference / d.variance;
      }
      if (information <= 0) break;
      const double mean = sum / information;
      deviation = squares / information - mean * mean;
      angle = wrapToRightAngle(angle + mean);
    }
    if (information <= 0) break;
    for (Direction& d : all)
      if (std::abs(wrapToRightAngle(d.angle - angle)) <= kWindow) d.isUsed = true;
    // A map that is bent has walls that disagree by more than their own covariances.
    found.push_back({angle, std::max(1 / information, std::max(0.0, deviation) / 4)});
  }
  return found;
}

bool snapTo(const std::vector<BuildingDirection>& directions, LineEstimate& line) {
  const BuildingDirection* best = nullptr;
  double least = 9;  // squared standard deviations
  for (const BuildingDirection& direction : directions) {
    const double turn = wrapToRightAngle(direction.angle - line.angle);
    const double distance = turn * turn / (line.covariance(1, 1) + direction.variance);
    if (distance < least) least = distance, best = &direction;
  }
  if (!best) return false;
  const double turn = wrapToRightAngle(best->angle - line.angle);
  line = turnedTo(line, std::remainder(line.angle + turn, 2 * M_PI), best->variance);
  return true;
}

}  // namespace hybrid_slam
