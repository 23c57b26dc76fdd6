#include <gtest/gtest.h>
#include <mrpt/io/CFileGZInputStream.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "slam/lines/LineExtractor.h"
#include "testing/TestLines.h"

namespace hybrid_slam {
namespace {

/// Prints the table of doc/paper-notes.md on the Intel log: angle of each line to the common direction of the
/// other lines of its scan.
TEST(LineExtractor, RealLogAgreesOnItsDominatingDirection) {
  using Method = LineFitOptions::Method;
  const char* folder = std::getenv("HYBRID_SLAM_DATASETS");
  if (!folder) GTEST_SKIP() << "HYBRID_SLAM_DATASETS is not set";
  mrpt::io::CFileGZInputStream file;
  ASSERT_TRUE(file.open(std::string(folder) + "/intel-lab.clf.gz"));
  std::vector<LaserScan> scans;
  for (std::string text; file.getline(text);) {
    std::istringstream row(text);
    std::string key;
    size_t beams = 0;
    if (!(row >> key) || key != "FLASER" || !(row >> beams)) continue;
    LaserScan scan;
    for (size_t i = 0; i < beams; ++i) {
      Beam beam{(static_cast<double>(i) - 90) * kDegree, 0, false};
      row >> beam.range;
      beam.valid = beam.range > 0 && beam.range < 20;
      scan.beams.push_back(beam);
    }
    scans.push_back(scan);
  }
  ASSERT_EQ(scans.size(), 4653u);

  std::printf(
      "| fit | Hough | split | lines a scan | of these above 5 m | median angle (deg) "
      "|\n|---|---|---|---|---|---|\n");
  const auto measure = [&scans](Method method, bool hough, bool split) {
    LineExtractionOptions options;
    options.segmentation.split = split;
    options.fit.method = method;
    options.hough.enabled = hough;
    std::vector<double> angles;
    size_t count = 0, longLines = 0;
    for (const LaserScan& scan : scans) {
      const auto lines = extractLines(scan, options);
      double sine = 0, cosine = 0;
      for (const LineSegment& line : lines) {
        sine += line.length * std::sin(4 * line.theta);
        cosine += line.length * std::cos(4 * line.theta);
        longLines += line.length > 5;
      }
      count += lines.size();
      for (const LineSegment& line : lines) {
        if (lines.size() < 2) continue;
        const double others = std::atan2(sine - line.length * std::sin(4 * line.theta),
                                         cosine - line.length * std::cos(4 * line.theta)) /
                              4;
        angles.push_back(std::abs(std::remainder(line.theta - others, M_PI / 2)) / kDegree);
      }
    }
    const double n = static_cast<double>(scans.size()), median = test::spread(angles).median;
    std::printf("| %s | %s | %s | %.2f | %.3f | %.2f |\n", method == Method::paper ? "paper" : "orthogonal",
                hough ? "yes" : "no", split ? "yes" : "no", static_cast<double>(count) / n,
                static_cast<double>(longLines) / n, median);
    return median;
  };
  const double byDefault = measure(Method::orthogonal, true, true);
  const double withoutHough = measure(Method::orthogonal, false, true);
  measure(Method::paper, true, true);
  const double byPaper = measure(Method::paper, false, true);
  measure(Method::paper, true, false);
  EXPECT_LT(byDefault, 3);
  EXPECT_LT(byDefault, withoutHough);
  EXPECT_LT(byDefault, byPaper);
}

}  // namespace
}  // namespace hybrid_slam
