/// @file Svg.h
/// @brief Just enough SVG for plots: shapes, text, axes.
#pragma once

#include <string>
#include <vector>

namespace hybrid_slam::comparison {

/// `&`, `<`, `>` and `"` as XML wants them.
std::string escapeXml(const std::string& text);
/// A coordinate or figure in at most `digits` significant digits, without an exponent where it can be.
std::string shortNumber(double value, int digits = 4);

/// Pixels, y downwards.
struct Point {
  double x = 0, y = 0;
};

enum class Anchor { start, middle, end };

/// A drawing that grows; all coordinates in pixels.
class Svg {
 public:
  Svg(double width, double height) : width_(width), height_(height) {}

  /// @param style  an SVG style: "stroke:#000;stroke-width:1"
  void line(Point a, Point b, const std::string& style);
  void polyline(const std::vector<Point>& points, const std::string& style);
  void polygon(const std::vector<Point>& points, const std::string& style);
  void rectangle(Point corner, double width, double height, const std::string& style);
  /// Squares around the points as one shape, which keeps a picture of thousands small.
  void squares(const std::vector<Point>& centres, double side, const std::string& style);
  /// @param title  shown by browsers when the pointer rests on it; may be empty
  void circle(Point centre, double radius, const std::string& style, const std::string& title = {});
  void text(Point at, const std::string& text, Anchor anchor = Anchor::start, const std::string& style = {});
  /// Text that reads upwards, for a y axis.
  void upwardsText(Point at, const std::string& text);

  double width() const { return width_; }
  double height() const { return height_; }
  /// The whole `<svg>` element. @param description  for those who cannot see it
  std::string str(const std::string& description) const;

 private:
  double width_, height_;
  std::string body_;
};

/// Values to pixels along one axis, linear or logarithmic.
class Axis {
 public:
  enum class Kind {
    linear,       ///< from tick to tick
    tight,        ///< linear, from low to high exactly
    logarithmic,  ///< a little wider than low and high
  };
  /// @param from,to  pixels of low and high
  Axis(double low, double high, Kind kind, double from, double to);

  double pixel(double value) const;
  const std::vector<double>& ticks() const { return ticks_; }
  double low() const { return low_; }
  double high() const { return high_; }

 private:
  double low_, high_;
  Kind kind_;
  double from_, to_;
  std::vector<double> ticks_;
};

/// The plot's area in pixels.
struct Frame {
  double left, top, right, bottom;
};

/// Grid lines, tick labels and title of a y axis.
void drawYAxis(Svg& svg, const Frame& frame, const Axis& axis, const std::string& title);
void drawXAxis(Svg& svg, const Frame& frame, const Axis& axis, const std::string& title);

/// Okabe & Ito's colours, which the colour-blind can tell apart.
std::string plotColour(size_t number);
/// An SVG style that tells lines of the same colour apart; empty for the first.
std::string plotDash(size_t number);

}  // namespace hybrid_slam::comparison
