#include "slam/lines/HoughRefinement.h"

#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>

#include <cstdio>

#include "base/Errors.h"
#include "testing/TestLines.h"

namespace hybrid_slam {
namespace {

using namespace test;

TEST(HoughRefinement, LeavesExactLinesAsTheyAre) {
  RandomStream random(1, 0, 0);
  for (int i = 0; i < 300; ++i) {
    const double rho = test::uniform(random, 0, 10), theta = test::uniform(random, -M_PI, M_PI);
    const auto points = test::pointsOnLine(rho, theta, -2, 4, 60, 0, random);
    const FittedLine line = refineByHough(test::range(points), {rho, theta}, {});
    EXPECT_NEAR(test::lineDistance(line.rho, line.theta, rho, theta), 0, 1e-9);
  }
}

/// A start that is off by less than the window is corrected, even if the segment is far from the foot of the
/// perpendicular, so that the angle error moves rho far beyond its window.
TEST(HoughRefinement, CorrectsAWrongStart) {
  RandomStream random(2, 0, 0);
  const HoughOptions options;
  for (int i = 0; i < 300; ++i) {
    const double theta = test::uniform(random, -M_PI, M_PI), beside = test::uniform(random, 0, 15);
    const auto points = test::pointsOnLine(3, theta, beside, beside + 4, 60, 0, random);
    const double wrong = theta + test::uniform(random, -0.9, 0.9) * options.thetaWindow;
    const TPoint2D centre(0.5 * (points.front().x + points.back().x),
                          0.5 * (points.front().y + points.back().y));
    const double off = test::uniform(random, -0.7, 0.7) * options.rhoWindow;
    const FittedLine line =
        refineByHough(test::range(points), {signedDistance(centre, 0, wrong) + off, wrong}, options);
    EXPECT_NEAR(test::lineDistance(line.rho, line.theta, 3, theta), 0, 1e-9);
  }
}

/// The quotient 0.15 / 0.05 is a little below 3 in floating point.
TEST(HoughRefinement, SearchesUpToTheWindowsEdge) {
  RandomStream random(5, 0, 0);
  HoughOptions options;
  options.rhoWindow = 0.15, options.rhoResolution = 0.05;
  options.thetaWindow = options.thetaResolution;
  const auto points = test::pointsOnLine(3, 0.2, -2, 2, 60, 0, random);
  for (const double off : {-0.15, 0.15}) {
    const FittedLine line = refineByHough(test::range(points), {3 + off, 0.2}, options);
    EXPECT_NEAR(test::lineDistance(line.rho, line.theta, 3, 0.2), 0, 1e-9) << off;
  }
}

TEST(HoughRefinement, NeverLeavesTheVotingSpaceByMoreThanItsCells) {
  RandomStream random(3, 0, 0);
  HoughOptions options;
  options.thetaWindow = 1 * kDegree;
  for (int i = 0; i < 100; ++i) {
    // The start is 8 deg off: the true line is outside the window and must not be reached.
    const auto points = test::pointsOnLine(3, 0.5, -0.5, 0.5, 60, 0.01, random);
    const FittedLine line = refineByHough(test::range(points), {3, 0.5 + 8 * kDegree}, options);
    EXPECT_GT(test::angleBetween(line.theta, 0.5), 1 * kDegree);
  }
}

/// Prints a table of doc/paper-notes.md: a wall seen by a laser (0.5 deg, 12 mm) with outliers in front of
/// it: single points 0.05 to 0.3 m off, or one piece that stands out by 0.06 m.
TEST(HoughRefinement, HelpsAgainstOutliersAndIsTheMeasuredDefault) {
  EXPECT_TRUE(HoughOptions().enabled);
  struct Scene {
    const char* name;
    bool piece;
    double share, leastGain;  ///< leastGain: median angle error of the fit over that of the refined line
  };
  std::printf("| outliers | fit alone | with Hough |\n|---|---|---|\n");
  for (const Scene& scene :
       {Scene{"none", false, 0, 0.8}, Scene{"20 % single points, 0.05 to 0.3 m in front", false, 0.2, 2},
        Scene{"10 % as one piece, 0.06 m in front", true, 0.1, 2},
        Scene{"20 % as one piece, 0.06 m in front", true, 0.2, 2}}) {
    RandomStream random(4, 0, 0);
    std::vector<double> fitErrors, houghErrors;
    for (int i = 0; i < 2000; ++i) {
      const double length = test::uniform(random, 2, 8), distance = test::uniform(random, 1, 6);
      const double beside = test::uniform(random, -2, 2), theta = test::uniform(random, -M_PI, M_PI);
      const double low = std::atan2(beside - length / 2, distance),
                   high = std::atan2(beside + length / 2, distance);
      const double pieceLow = test::uniform(random, low, high - scene.share * (high - low));
      std::vector<TPoint2D> points;
      for (double angle = low; angle <= high; angle += 0.5 * kDegree) {
        double r = distance / std::cos(angle) + 0.012 * random.gaussian();
        if (scene.piece && angle >= pieceLow && angle < pieceLow + scene.share * (high - low))
          r -= 0.06 / std::cos(angle);
        if (!scene.piece && random.uniform() < scene.share) r -= test::uniform(random, 0.05, 0.3);
        points.emplace_back(r * std::cos(angle + theta), r * std::sin(angle + theta));
      }
      const auto fit = fitOrthogonal(test::range(points));
      ASSERT_TRUE(fit);
      fitErrors.push_back(test::angleBetween(fit->theta, theta) / kDegree);
      houghErrors.push_back(test::angleBetween(refineByHough(test::range(points), *fit, {}).theta, theta) /
                            kDegree);
    }
    const Spread fit = test::spread(fitErrors), hough = test::spread(houghErrors);
    std::printf("| %s | %.3f / %.3f | %.3f / %.3f |\n", scene.name, fit.median, fit.rms, hough.median,
                hough.rms);
    EXPECT_GE(fit.median / hough.median, scene.leastGain) << scene.name;
  }
}

TEST(HoughOptions, RangesAreChecked) {
  for (const char* line : {"rho_resolution = 0", "theta_window_deg = 50", "theta_resolution_deg = 0",
                           "rho_window = -1", "enabled = 2"}) {
    HoughOptions options;
    const mrpt::config::CConfigFileMemory file(std::string("[hough]\n") + line + "\n");
    EXPECT_THROW(options.loadFromConfigFile(file, "hough"), InputError) << line;
  }
}

}  // namespace
}  // namespace hybrid_slam
