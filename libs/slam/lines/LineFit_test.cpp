#include "slam/lines/LineFit.h"

#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>

#include <Eigen/Dense>
#include <cstdio>

#include "base/Errors.h"
#include "testing/TestLines.h"

namespace hybrid_slam {
namespace {

using namespace test;

using Method = LineFitOptions::Method;

TEST(OrthogonalFit, ExactLinesOfEveryDirection) {
  RandomStream random(1, 0, 0);
  for (int i = 0; i < 1000; ++i) {
    const double rho = test::uniform(random, 0, 20), theta = test::uniform(random, -M_PI, M_PI);
    const auto line = fitOrthogonal(test::range(test::pointsOnLine(rho, theta, -3, 5, 20, 0, random)));
    ASSERT_TRUE(line);
    EXPECT_NEAR(test::lineDistance(line->rho, line->theta, rho, theta), 0, 1e-9);
  }
}

/// The closed form: the normal is the eigenvector of the scatter matrix with the smaller eigenvalue, and the
/// mean square distance is that eigenvalue / N.
TEST(OrthogonalFit, AgreesWithTheEigenvectorsOfTheScatterMatrix) {
  RandomStream random(2, 0, 0);
  for (int i = 0; i < 300; ++i) {
    const auto points = test::pointsOnLine(test::uniform(random, 0, 5), test::uniform(random, -M_PI, M_PI),
                                           -1, 2, 30, 0.1, random);
    Eigen::Matrix2Xd m(2, points.size());
    for (size_t k = 0; k < points.size(); ++k)
      m.col(static_cast<Eigen::Index>(k)) << points[k].x, points[k].y;
    const Eigen::Vector2d mean = m.rowwise().mean();
    m.colwise() -= mean;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(m * m.transpose());
    const Eigen::Vector2d normal = solver.eigenvectors().col(0);
    const auto line = fitOrthogonal(test::range(points));
    ASSERT_TRUE(line);
    EXPECT_NEAR(
        test::lineDistance(line->rho, line->theta, normal.dot(mean), std::atan2(normal.y(), normal.x())), 0,
        1e-9);
    EXPECT_NEAR(rmsDistance(test::range(points), *line),
                std::sqrt(solver.eigenvalues()(0) / static_cast<double>(points.size())), 1e-9);
  }
}

TEST(OrthogonalFit, InvariantUnderRotationAndTranslation) {
  RandomStream random(3, 0, 0);
  for (int i = 0; i < 1000; ++i) {
    const auto points = test::pointsOnLine(2, test::uniform(random, -M_PI, M_PI), -2, 3, 40, 0.02, random);
    const TPose2D frame = test::randomPose(random, 20);
    std::vector<TPoint2D> moved;
    for (const TPoint2D& p : points) moved.push_back(frame.composePoint(p));
    const auto line = fitOrthogonal(test::range(points)), other = fitOrthogonal(test::range(moved));
    ASSERT_TRUE(line && other);
    const LineSegment expected =
        transformed(makeSegment(line->rho, line->theta, points.front(), points.back()), frame);
    EXPECT_NEAR(test::lineDistance(other->rho, other->theta, expected.rho, expected.theta), 0, 1e-9);
    EXPECT_NEAR(rmsDistance(test::range(moved), *other), rmsDistance(test::range(points), *line), 1e-9);
  }
}

TEST(OrthogonalFit, NoLineThroughFewerThanTwoDistinctPoints) {
  EXPECT_FALSE(fitOrthogonal({}));
  EXPECT_FALSE(fitOrthogonal(test::range(std::vector<TPoint2D>{{1, 2}})));
  EXPECT_FALSE(fitOrthogonal(test::range(std::vector<TPoint2D>(5, TPoint2D(1, 2)))));
  EXPECT_TRUE(fitOrthogonal(test::range(std::vector<TPoint2D>{{1, 2}, {1, 3}})));
}

TEST(OrthogonalFit, AWeightCountsAPointThatManyTimes) {
  RandomStream random(3, 0, 1);
  for (int i = 0; i < 100; ++i) {
    const auto points = test::pointsOnLine(2, test::uniform(random, -M_PI, M_PI), -1, 2, 12, 0.1, random);
    std::vector<double> weights;
    std::vector<TPoint2D> repeated;
    for (size_t k = 0; k < points.size(); ++k) {
      weights.push_back(static_cast<double>(k % 4));
      repeated.insert(repeated.end(), k % 4, points[k]);
    }
    const auto line = fitOrthogonal(test::range(points), weights),
               expected = fitOrthogonal(test::range(repeated));
    ASSERT_TRUE(line && expected);
    EXPECT_NEAR(test::lineDistance(line->rho, line->theta, expected->rho, expected->theta), 0, 1e-9);
  }
}

/// eq. (2)-(4) by hand for (1, 1), (2, 3), (4, 4): sums x 7, y 8, xx 21, yy 26, xy 23.
TEST(PaperFit, CoefficientsByHand) {
  const std::vector<TPoint2D> points{{1, 1}, {2, 3}, {4, 4}};
  const LineCoefficients line = fitCoefficients(test::range(points));
  EXPECT_EQ(line.a, 7 * 26 - 8 * 23);
  EXPECT_EQ(line.b, 8 * 21 - 7 * 23);
  EXPECT_EQ(line.c, 23 * 23 - 21 * 26);
  // y = (2 x + 17) / 7: residuals 12/7, 0, 3/7... summed from eq. (5).
  double sum = 0;
  for (const TPoint2D& p : points) sum += std::pow((2 * p.x + 17) / 7 - p.y, 2);
  EXPECT_NEAR(verticalError(test::range(points), line), sum, 1e-12);
}

/// Eq. (2)-(4) are the least-squares solution of (a/c) x + (b/c) y = -1.
TEST(PaperFit, MinimisesTheAlgebraicResidual) {
  RandomStream random(4, 0, 0);
  for (int i = 0; i < 300; ++i) {
    const auto points = test::pointsOnLine(test::uniform(random, 1, 5), test::uniform(random, -M_PI, M_PI),
                                           -1, 2, 30, 0.05, random);
    Eigen::MatrixX2d m(points.size(), 2);
    for (size_t k = 0; k < points.size(); ++k)
      m.row(static_cast<Eigen::Index>(k)) << points[k].x, points[k].y;
    const Eigen::Vector2d expected =
        m.colPivHouseholderQr().solve(-Eigen::VectorXd::Ones(static_cast<Eigen::Index>(points.size())));
    const LineCoefficients line = fitCoefficients(test::range(points));
    EXPECT_NEAR(line.a / line.c, expected.x(), 1e-9);
    EXPECT_NEAR(line.b / line.c, expected.y(), 1e-9);
  }
}

/// eq. (6) with our signs; the printed one gives (-rho, -theta).
TEST(PaperFit, HesseFormOfExactLines) {
  RandomStream random(5, 0, 0);
  for (int i = 0; i < 1000; ++i) {
    const double rho = test::uniform(random, 0.5, 10), theta = test::uniform(random, -M_PI, M_PI);
    const LineCoefficients c =
        fitCoefficients(test::range(test::pointsOnLine(rho, theta, -3, 2, 20, 0, random)));
    const auto line = toHesse(c);
    ASSERT_TRUE(line);
    EXPECT_NEAR(line->rho, rho, 1e-8);
    EXPECT_NEAR(std::remainder(line->theta - theta, 2 * M_PI), 0, 1e-8);
    EXPECT_NEAR(c.c / std::hypot(c.a, c.b), -rho, 1e-8);
    EXPECT_NEAR(test::angleBetween(std::atan(-c.b / c.a), -theta), 0, 1e-8);
  }
}

TEST(PaperFit, NoLineWhereThePointsLieOnALineThroughTheOrigin) {
  const std::vector<TPoint2D> points{{1, 2}, {2, 4}, {3, 6}};
  const LineCoefficients line = fitCoefficients(test::range(points));
  EXPECT_EQ(line.a, 0);
  EXPECT_EQ(line.b, 0);
  EXPECT_EQ(line.c, 0);
  EXPECT_FALSE(toHesse(line));
  LineFitOptions options;
  options.method = Method::paper;
  EXPECT_FALSE(fitLine(test::range(points), options));
}

TEST(PaperFit, AVerticalLineHasAnInfiniteError) {
  const std::vector<TPoint2D> points{{2, -1}, {2, 0}, {2, 1}};
  const LineCoefficients line = fitCoefficients(test::range(points));
  EXPECT_EQ(line.b, 0);
  EXPECT_TRUE(std::isinf(verticalError(test::range(points), line)));
}

TEST(LineFit, SegmentsAboveTheErrorLimitAreDropped) {
  const std::vector<TPoint2D> points{{-1, 2.1}, {0, 1.9}, {1, 1.9}, {2, 2.1}};  // y = 2, residuals 0.1
  LineFitOptions options;
  options.maxRms = 0.101;
  EXPECT_TRUE(fitLine(test::range(points), options));
  options.maxRms = 0.099;
  EXPECT_FALSE(fitLine(test::range(points), options));

  options.method = Method::paper;
  const double error = verticalError(test::range(points), fitCoefficients(test::range(points)));
  EXPECT_GT(error, 0.039);  // the least sum of squares along y is 0.04
  options.maxError = 1.01 * error;
  EXPECT_TRUE(fitLine(test::range(points), options));
  options.maxError = 0.99 * error;
  EXPECT_FALSE(fitLine(test::range(points), options));
}

/// Prints a table of doc/paper-notes.md: 12 mm of range noise, 40 points on 1 to 4 m.
TEST(LineFit, OrthogonalIsTheMeasuredDefault) {
  struct Class {
    const char* name;
    double lowRho, highRho, lowTheta, highTheta;
    double leastRatio;  ///< rms angle error of the paper's fit over that of the orthogonal one
  };
  EXPECT_EQ(LineFitOptions().method, Method::orthogonal);
  std::printf(
      "| lines | orthogonal, median / rms (deg) | eq. (2)-(4), median / rms (deg) "
      "| kept by eq. (5) <= 0.1 m^2 |\n|---|---|---|---|\n");
  for (const Class& c : {Class{"any direction, rho 0.5 to 5 m", 0.5, 5, -M_PI, M_PI, 0.99},
                         Class{"vertical within 1 deg, rho 0.5 to 5 m", 0.5, 5, -kDegree, kDegree, 0.99},
                         Class{"rho 0.1 to 0.5 m", 0.1, 0.5, -M_PI, M_PI, 1.1},
                         Class{"rho below 0.05 m", 0, 0.05, -M_PI, M_PI, 20}}) {
    RandomStream random(6, 0, 0);
    std::vector<double> orthogonalErrors, paperErrors;
    int dropped = 0, orthogonalDropped = 0;
    constexpr int kLines = 5000;
    for (int i = 0; i < kLines; ++i) {
      const double rho = test::uniform(random, c.lowRho, c.highRho),
                   theta = test::uniform(random, c.lowTheta, c.highTheta);
      const double from = test::uniform(random, -2, 1), to = from + test::uniform(random, 1, 4);
      const auto points = test::pointsOnLine(rho, theta, from, to, 40, 0.012, random);
      const LineCoefficients coefficients = fitCoefficients(test::range(points));
      const auto orthogonal = fitOrthogonal(test::range(points)), paper = toHesse(coefficients);
      ASSERT_TRUE(orthogonal && paper);
      orthogonalErrors.push_back(test::angleBetween(orthogonal->theta, theta) / kDegree);
      paperErrors.push_back(test::angleBetween(paper->theta, theta) / kDegree);
      dropped += verticalError(test::range(points), coefficients) > LineFitOptions().maxError;
      orthogonalDropped += rmsDistance(test::range(points), *orthogonal) > LineFitOptions().maxRms;
    }
    const Spread o = test::spread(orthogonalErrors), p = test::spread(paperErrors);
    std::printf("| %s | %.3f / %.3f | %.3f / %.3f | %.0f %% |\n", c.name, o.median, o.rms, p.median, p.rms,
                100 - 100.0 * dropped / kLines);
    EXPECT_GE(p.rms / o.rms, c.leastRatio) << c.name;
    EXPECT_EQ(orthogonalDropped, 0) << c.name;
  }
}

TEST(LineFitOptions, NamesAndRanges) {
  LineFitOptions options;
  options.loadFromConfigFile(mrpt::config::CConfigFileMemory("[line_fit]\nmethod = paper\nmax_rms = 0.5\n"),
                             "line_fit");
  EXPECT_EQ(options.method, Method::paper);
  EXPECT_EQ(options.maxRms, 0.5);
  for (const char* line : {"method = least", "max_rms = -1", "max_error = x"})
    EXPECT_THROW(options.loadFromConfigFile(
                     mrpt::config::CConfigFileMemory(std::string("[line_fit]\n") + line + "\n"), "line_fit"),
                 InputError)
        << line;
}

}  // namespace
}  // namespace hybrid_slam
