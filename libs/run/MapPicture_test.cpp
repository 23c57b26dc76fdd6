#include "run/MapPicture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "run/MapFrame.h"
#include "testing/PictureRoom.h"

namespace hybrid_slam::run {
namespace {

using mrpt::maps::COccupancyGridMap2D;

/// The room of 101 x 61 cells of 0.05 m with its corner at (0.5, -3.5), and its picture.
class Picture : public testing::Test {
 protected:
  void draw(const COccupancyGridMap2D& grid, const files::Trajectory& path,
            const std::vector<DatabaseLine>& lines = {}, const std::vector<DoubtfulPlace>& doubtful = {}) {
    const std::string png = mapPicture(MapRaster(grid, path), {path, lines, doubtful});
    image = cv::imdecode(std::vector<char>(png.begin(), png.end()), cv::IMREAD_COLOR);
    ASSERT_FALSE(image.empty());
    findFrame();
  }
  /// Finds the frame: the outermost long dark rows and columns.
  void findFrame() {
    const auto isFrame = [](const cv::Vec3b& c) { return c == cv::Vec3b(60, 60, 60); };
    const auto count = [&](const cv::Mat& strip) {
      return std::count_if(strip.begin<cv::Vec3b>(), strip.end<cv::Vec3b>(), isFrame);
    };
    std::vector<int> columns, rows;
    for (int x = 0; x < image.cols; ++x)
      if (count(image.col(x)) > image.rows / 3) columns.push_back(x);
    for (int y = 0; y < image.rows; ++y)
      if (count(image.row(y)) > image.cols / 3) rows.push_back(y);
    ASSERT_GE(columns.size(), 2u);
    ASSERT_GE(rows.size(), 2u);
    const auto [left, right] = widestGap(columns);
    const auto [top, bottom] = widestGap(rows);
    map = cv::Rect(left + 1, top + 1, right - left - 1, bottom - top - 1);
  }
  static std::pair<int, int> widestGap(const std::vector<int>& sorted) {
    std::pair<int, int> widest(0, 0);
    for (size_t i = 1; i < sorted.size(); ++i)
      if (sorted[i] - sorted[i - 1] > widest.second - widest.first) widest = {sorted[i - 1], sorted[i]};
    return widest;
  }
  /// Pixels per metre in the room's picture.
  double scale() const { return map.width / 101. / 0.05; }
  cv::Vec3b at(double x, double y) const {
    return image.at<cv::Vec3b>(map.y + static_cast<int>((-0.45 - y) * scale()),
                               map.x + static_cast<int>((x - 0.5) * scale()));
  }
  int grey(double x, double y) const {
    const cv::Vec3b c = at(x, y);
    return c[0] == c[1] && c[1] == c[2] ? c[0] : -1;
  }
  /// Compares colours with a tolerance: antialiased lines are paler beside their middle.
  static bool isLike(const cv::Vec3b& a, const cv::Vec3b& b) { return cv::norm(a, b) < 120; }
  /// Number of pixels of a colour in the legend.
  int legendPixels(const cv::Vec3b& colour) const {
    const cv::Mat legend = image.rowRange(map.y + map.height + 1, image.rows);
    return static_cast<int>(
        std::count_if(legend.begin<cv::Vec3b>(), legend.end<cv::Vec3b>(), [&colour](const cv::Vec3b& c) {
          return c == colour || (colour[0] != colour[2] && isLike(c, colour));
        }));
  }
  cv::Mat image;
  cv::Rect map;
};

const cv::Vec3b kRed(0, 0, 220), kGreen(0, 160, 0), kBlue(255, 180, 80), kOrange(0, 140, 255);

TEST_F(Picture, WallsPathLinesAndRobotAreWhereTheyShouldBe) {
  DatabaseLine line;
  line.start = {1.2, -0.975}, line.end = {4.8, -0.975};
  draw(test::pictureRoom(0.05f), {{0, {1.5, -2.2, 0}}, {1, {4.4, -2.2, 0}}}, {line});
  ASSERT_EQ(map.width % 101, 0);
  EXPECT_EQ(map.height * 101, map.width * 61);
  for (const auto& [x, y] : {std::pair(1.025, -2.4), {5.025, -2.4}, {3.3, -2.975}})
    EXPECT_EQ(grey(x, y), 0) << "wall at " << x << ' ' << y;
  EXPECT_EQ(grey(3.3, -2.6), 254) << "free inside";
  EXPECT_EQ(grey(0.7, -2.6), 205) << "unknown outside";
  EXPECT_PRED2(isLike, at(2.5, -2.2), kRed);
  EXPECT_PRED2(isLike, at(3.3, -0.975), kGreen);
  EXPECT_PRED2(isLike, at(4.65, -2.2), kBlue) << "the robot is at the end of its path and looks along x";
}

TEST_F(Picture, ALineIsNotDrawnInFreeSpace) {
  DatabaseLine line;
  line.start = {0.9, -2}, line.end = {5.1, -2};  // through both walls of the room
  draw(test::pictureRoom(0.05f), {}, {line});
  for (const double x : {1.3, 2.3, 3.3, 4.7}) EXPECT_EQ(grey(x, -2.02), 254) << x;
  line.start = {1.2, -0.975}, line.end = {4.8, -0.975};
  COccupancyGridMap2D grid = test::pictureRoom(0.05f);
  for (float x = 1.025f; x < 5; x += 0.05f) grid.setPos(x, -0.975f, 0.4f);  // a wall that was hit once
  draw(grid, {}, {line});
  for (const double x : {1.3, 2.3, 3.3, 4.7}) EXPECT_PRED2(isLike, at(x, -0.975), kGreen) << x;
}

TEST_F(Picture, CirclesSurroundDoubtfulPlaces) {
  const auto draws = [this](double length) {
    DoubtfulPlace place;
    place.at = {3.25, -2.25}, place.length = length;
    draw(test::pictureRoom(0.05f), {}, {}, {place});
  };
  draws(0);  // a radius of 1 m, and half of the length
  for (const auto& [x, y] : {std::pair(4.25, -2.25), {2.25, -2.25}, {3.25, -1.25}})
    EXPECT_PRED2(isLike, at(x, y), kOrange) << x << ' ' << y;
  EXPECT_EQ(grey(3.25, -2.25), 254) << "the middle shows the map";
  draws(1);
  EXPECT_PRED2(isLike, at(4.75, -2.25), kOrange);
  EXPECT_EQ(grey(4.25, -2.25), 254);
}

TEST_F(Picture, FreeSpaceThatFewBeamsCrossedIsWhite) {
  COccupancyGridMap2D grid = test::pictureRoom(0.05f);
  for (const float y : {-2.025f, -2.075f}) grid.setPos(2.525f, y, 0.516f);  // one beam
  draw(grid, {});
  EXPECT_EQ(grey(2.525, -2.05), 254);
}

TEST_F(Picture, FaintLinesLieAtRoundCoordinates) {
  draw(test::pictureRoom(0.05f), {});
  for (const double metre : {2., 3., 4.}) {
    const double pixel = 0.5 / scale();
    EXPECT_LT(grey(metre + pixel, -2.6), 240) << metre;
    for (const double beside : {-2 * pixel, 3 * pixel}) EXPECT_EQ(grey(metre + beside, -2.6), 254) << metre;
  }
  EXPECT_LT(grey(3.3, -2 - 0.5 / scale()), 240);
}

TEST_F(Picture, TheScaleBarHasARoundLength) {
  draw(test::pictureRoom(0.05f), {});
  int longest = 0;
  for (int y = map.y + map.height + 1; y < image.rows; ++y)
    for (int x = 0, run = 0; x < image.cols; ++x) {
      run = image.at<cv::Vec3b>(y, x) == cv::Vec3b(0, 0, 0) ? run + 1 : 0;
      longest = std::max(longest, run);
    }
  EXPECT_NEAR(longest / scale(), 0.5, 0.02);
}

TEST_F(Picture, TheLegendHoldsWhatIsShown) {
  draw(test::pictureRoom(0.05f), {});
  for (const cv::Vec3b& colour : {kRed, kGreen, kBlue, kOrange}) EXPECT_EQ(legendPixels(colour), 0);
  for (const int cell : {0, 254, 205})
    EXPECT_GT(legendPixels(cv::Vec3b::all(static_cast<uint8_t>(cell))), 20);
  const DatabaseLine line;
  draw(test::pictureRoom(0.05f), {{0, {2, -2, 0}}}, {line}, {DoubtfulPlace()});
  for (const cv::Vec3b& colour : {kRed, kGreen, kBlue, kOrange}) EXPECT_GT(legendPixels(colour), 5);
}

TEST(MapPicture, OfAnUnknownMapAndPosesFarAway) {
  COccupancyGridMap2D grid;
  grid.setSize(0, 1, 0, 1, 0.05f, 0.5f);
  const files::Trajectory path{{0, {1e9, -1e9, 0}}, {1, {-1e9, 1e300, 0}}};
  const MapRaster map(grid, path);
  EXPECT_EQ(map.width(), 20);
  EXPECT_GT(mapPicture(map, {path, {}, {}}).size(), 100u);
}

TEST_F(Picture, OfALargeMapIsReducedAndKeepsThinWalls) {
  COccupancyGridMap2D grid;
  grid.setSize(0, 1200, 0, 600, 0.05f, 0.5f);  // 24,000 x 12,000 cells
  for (int x = 1; x < 23999; ++x) grid.setCell(x, 6001, 0.03f);
  grid.setCell(0, 0, 0.9f), grid.setCell(23999, 11999, 0.9f);
  draw(grid, {{0, {300, 150, 0}}, {1, {900, 150, 0}}});
  ASSERT_EQ(map.width, 8000);
  ASSERT_EQ(map.height, 4000);
  const auto pixel = [this](int x, int y) { return image.at<cv::Vec3b>(map.y + y, map.x + x); };
  for (const int x : {10, 3333, 7990}) EXPECT_EQ(pixel(x, 1999), cv::Vec3b(0, 0, 0)) << "the wall";
  EXPECT_EQ(pixel(3333, 1500), cv::Vec3b(205, 205, 205)) << "unknown";
  EXPECT_PRED2(isLike, pixel(3333, 3000), kRed);
}

/// The map is 2.7 m wide at 80 pixels per metre. Its grid lines must be 1 m apart, because the label "-0.5 m"
/// is 48 pixels long.
TEST(MapFrame, ASmallPictureHasRoomForItsCoordinates) {
  cv::Mat map(200, 216, CV_8UC3, cv::Scalar::all(250));
  drawGrid(map, {-1.05, 1.5, 80});
  std::vector<int> columns;
  for (int x = 0; x < map.cols; ++x)
    if (map.at<cv::Vec3b>(0, x)[0] < 250) columns.push_back(x);
  EXPECT_EQ(columns, (std::vector{4, 84, 164}));
}

TEST(MapFrame, RoundNumbers) {
  for (const auto& [most, expected] :
       {std::pair(1., 1.), {1.99, 1.}, {2., 2.}, {4.9, 2.}, {5., 5.}, {99., 50.}, {0.7, 0.5}, {0.013, 0.01}})
    EXPECT_NEAR(roundNumber(most), expected, 1e-9) << most;
}

}  // namespace
}  // namespace hybrid_slam::run
