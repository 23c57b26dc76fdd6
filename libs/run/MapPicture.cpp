#include "run/MapPicture.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "run/MapFrame.h"

namespace hybrid_slam::run {
namespace {

const cv::Scalar kPath(0, 0, 220), kLine(0, 160, 0), kRobot(255, 180, 80), kDoubtful(0, 140, 255);  // BGR

/// Returns the cells per pixel side that limit a picture to 2^26 pixels (RGB: 200 MB), 2^14 per side.
int reductionOf(const MapRaster& map) {
  constexpr double kMostPixels = 1 << 26, kLongestSide = 1 << 14;
  const double pixels = static_cast<double>(map.width()) * map.height();
  const double longest = std::max(map.width(), map.height());
  return static_cast<int>(
      std::ceil(std::max({1.0, std::sqrt(pixels / kMostPixels), longest / kLongestSide})));
}

cv::Mat cellsOf(const MapRaster& map, int enlarged, int reduced) {
  cv::Mat picture((map.height() * enlarged + reduced - 1) / reduced,
                  (map.width() * enlarged + reduced - 1) / reduced, CV_8UC3);
  for (int y = 0; y < picture.rows; ++y) {
    uint8_t* pixel = picture.ptr<uint8_t>(y);
    for (int x = 0; x < picture.cols; ++x, pixel += 3)
      std::fill_n(pixel, 3, map.at(x * reduced / enlarged, y * reduced / enlarged, reduced));
  }
  return picture;
}

/// Draws shapes given in metres, antialiased, with subpixel accuracy, clipped to the picture.
class Pen {
 public:
  Pen(cv::Mat& map, const MapArea& area)
      : map_(map), area_(area), thin_(thinLine(std::max(map.cols, map.rows))) {}

  int thin() const { return thin_; }
  double radius(double metres) const { return metres * area_.pixelsPerMetre; }
  void line(double x0, double y0, double x1, double y1, const cv::Scalar& colour, int thickness) {
    cv::line(map_, at(x0, y0), at(x1, y1), colour, thickness, cv::LINE_AA, kShift);
  }
  void circle(double x, double y, double pixels, const cv::Scalar& colour, int thickness) {
    cv::circle(map_, at(x, y), static_cast<int>(std::lround(pixels * (1 << kShift))), colour, thickness,
               cv::LINE_AA, kShift);
  }

 private:
  static constexpr int kShift = 4;  // bits of a pixel's fractions
  cv::Point at(double x, double y) const {
    const auto fixedPoint = [this](double metres) {
      constexpr double kFarthest = 1 << 20;
      const double pixels = std::clamp(metres * area_.pixelsPerMetre - 0.5, -kFarthest, kFarthest);
      return static_cast<int>(std::lround(pixels * (1 << kShift)));
    };
    return {fixedPoint(x - area_.left), fixedPoint(area_.top - y)};
  }
  cv::Mat& map_;
  MapArea area_;
  int thin_;
};

void drawRobot(Pen& pen, const mrpt::math::TPose2D& robot) {
  const double radius = std::max(5. * pen.thin(), pen.radius(kRobotRadius)), metres = radius / pen.radius(1);
  pen.circle(robot.x, robot.y, radius, kRobot, 2 * pen.thin());
  pen.line(robot.x, robot.y, robot.x + metres * std::cos(robot.phi), robot.y + metres * std::sin(robot.phi),
           kRobot, 2 * pen.thin());
}

/// Whether a point and all cells around it are free. A wall that was hit once is neither free nor occupied.
bool isFree(const MapRaster& map, const mrpt::math::TPoint2D& point) {
  constexpr int kAround = 2;  // cells; a wall has this thickness
  const int column = static_cast<int>((point.x - map.left()) / map.cell());
  const int row = map.height() - 1 - static_cast<int>((point.y - map.bottom()) / map.cell());
  for (int j = row - kAround; j <= row + kAround; ++j)
    for (int i = column - kAround; i <= column + kAround; ++i)
      if (i < 0 || j < 0 || i >= map.width() || j >= map.height() || map.at(i, j) != MapRaster::kFree)
        return false;
  return true;
}

/// Draws a line where the map has a wall: the database joins collinear walls, also across an opening.
void drawLine(Pen& pen, const MapRaster& map, const DatabaseLine& line) {
  constexpr double kShortest = 0.3;  // m; at the far side of a corridor, the line touches the wall
  const int steps = static_cast<int>((line.end - line.start).norm() / map.cell());
  const auto at = [&](double step) { return line.start + (line.end - line.start) * (step / steps); };
  for (int first = 0, end; first < steps; first = end + 1) {
    for (end = first; end < steps && !isFree(map, at(end + 0.5));) ++end;
    if ((end - first) * map.cell() < kShortest) continue;
    const auto from = at(first), to = at(end);
    pen.line(from.x, from.y, to.x, to.y, kLine, 2 * pen.thin());
  }
}

void draw(Pen pen, const MapRaster& map, const MapMarks& marks) {
  for (const DatabaseLine& line : marks.lines) drawLine(pen, map, line);
  const files::Trajectory& path = marks.trajectory;
  for (size_t i = 1; i < path.size(); ++i)
    pen.line(path[i - 1].pose.x, path[i - 1].pose.y, path[i].pose.x, path[i].pose.y, kPath, pen.thin());
  if (!path.empty()) drawRobot(pen, path.back().pose);
  for (const DoubtfulPlace& place : marks.doubtful)
    pen.circle(place.at.x, place.at.y, pen.radius(std::min(1 + place.length / 2, 5.0)), kDoubtful,
               3 * pen.thin());
}

LegendItem cells(const char* label, uint8_t grey) {
  return {label, 1.5, [grey](cv::Mat& picture, const cv::Rect& symbol) {
            cv::rectangle(picture, symbol, cv::Scalar::all(grey), cv::FILLED);
            cv::rectangle(picture, symbol, cv::Scalar::all(120), 1);
          }};
}

LegendItem stroke(const char* label, const cv::Scalar& colour, int thickness) {
  return {label, 2, [=](cv::Mat& picture, const cv::Rect& symbol) {
            const int y = symbol.y + symbol.height / 2;
            cv::line(picture, {symbol.x, y}, {symbol.x + symbol.width, y}, colour, thickness, cv::LINE_AA);
          }};
}

LegendItem circle(const char* label, const cv::Scalar& colour, int thickness, bool hasHeading) {
  return {label, 1, [=](cv::Mat& picture, const cv::Rect& symbol) {
            const int radius = symbol.height / 2;
            const cv::Point centre(symbol.x + radius, symbol.y + radius);
            cv::circle(picture, centre, radius, colour, thickness, cv::LINE_AA);
            if (hasHeading)
              cv::line(picture, centre, centre + cv::Point(radius, 0), colour, thickness, cv::LINE_AA);
          }};
}

std::vector<LegendItem> legendOf(const MapMarks& marks, int thin) {
  std::vector<LegendItem> legend{cells("occupied", MapRaster::kOccupied), cells("free", MapRaster::kFree),
                                 cells("unknown", MapRaster::kUnknown)};
  if (!marks.trajectory.empty()) {
    legend.push_back(stroke("path", kPath, thin));
    legend.push_back(circle("robot at the end", kRobot, 2 * thin, true));
  }
  if (!marks.lines.empty()) legend.push_back(stroke("lines", kLine, 2 * thin));
  if (!marks.doubtful.empty()) legend.push_back(circle("doubtful place", kDoubtful, 3 * thin, false));
  return legend;
}

}  // namespace

std::string mapPicture(const MapRaster& map, const MapMarks& marks) {
  // Small maps are enlarged, so that path and lines do not hide the walls.
  const int enlarged = std::clamp(2000 / std::max(map.width(), map.height()), 1, 4);
  const int reduced = reductionOf(map);
  const MapArea area{map.left(), map.bottom() + map.height() * map.cell(), enlarged / (reduced * map.cell())};
  cv::Mat picture = cellsOf(map, enlarged, reduced);
  drawGrid(picture, area);
  draw(Pen(picture, area), map, marks);
  picture = framed(picture, area, legendOf(marks, thinLine(std::max(picture.cols, picture.rows))));
  // Encoded in memory: libpng would print a full disk to standard error itself.
  std::vector<unsigned char> png;
  // Runs of equal pixels: a quarter less time than with zlib's default, and the file is a tenth larger.
  cv::imencode(".png", picture, png,
               {cv::IMWRITE_PNG_COMPRESSION, 6, cv::IMWRITE_PNG_STRATEGY, cv::IMWRITE_PNG_STRATEGY_RLE});
  return {png.begin(), png.end()};
}

}  // namespace hybrid_slam::run
