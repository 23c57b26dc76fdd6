/// @file ReplayedLog.h
/// @brief For the tests: all readings of a log.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/math/TPose2D.h>

#include <limits>
#include <string>
#include <vector>

#include "base/Errors.h"
#include "files/TemporaryFolder.h"
#include "readings/RawlogSource.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::test {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Result of a log: its summary, and each scan's odometry pose relative to the first.
struct Replayed {
  readings::RawlogSummary summary;
  std::vector<double> times, x, phi;
  std::vector<size_t> entries;                      ///< log entries read when each scan was returned
  std::vector<CObservation2DRangeScan::Ptr> scans;  ///< the latest of each reading
  std::vector<Scans> allScans;
  std::vector<std::vector<size_t>> sizes;  ///< beams of the scans of each reading
  std::vector<mrpt::math::TPose2D> poses;  ///< by odometry, from that of the first reading
  std::string error;
};

inline Replayed replayed(const Log& log, const readings::InputOptions& options = {}, bool isGzipped = false) {
  const files::TemporaryFolder folder;
  const std::string path = folder.path("log");
  isGzipped ? writeGzipped(path, log) : writePlain(path, log);
  Replayed out;
  try {
    out.summary = readings::summarise(path, options);
  } catch (const InputError& e) {
    out.error = e.what();
    return out;
  }
  readings::RawlogSource source(path, options, out.summary);
  mrpt::math::TPose2D pose;
  while (const auto reading = source.next()) {
    pose = pose + reading->motion;
    out.times.push_back(reading->timestamp);
    out.x.push_back(pose.x);
    out.phi.push_back(pose.phi);
    out.entries.push_back(source.entry());
    out.scans.push_back(reading->scans.back());
    out.allScans.push_back(reading->scans);
    out.sizes.emplace_back();
    for (const auto& s : reading->scans) out.sizes.back().push_back(s->getScanSize());
    out.poses.push_back(pose);
  }
  EXPECT_EQ(out.times.size(), out.summary.scans) << "the summary gives the number of scans";
  EXPECT_EQ(source.entry(), out.summary.entries);
  EXPECT_FALSE(source.next()) << "an end stays an end";
  return out;
}

/// Matches values within 1e-6.
inline auto areNear(const std::vector<double>& expected) {
  std::vector<::testing::Matcher<double>> each;
  for (const double value : expected) each.push_back(::testing::DoubleNear(value, 1e-6));
  return ::testing::ElementsAreArray(each);
}

}  // namespace hybrid_slam::test
