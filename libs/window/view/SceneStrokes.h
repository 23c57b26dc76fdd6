/// @file SceneStrokes.h
/// @brief Shapes of a scene seen from above, and the colours of a filter's layers.
#pragma once

#include <mrpt/img/TColor.h>
#include <mrpt/math/TPoint2D.h>
#include <mrpt/opengl/CSetOfTriangles.h>

#include <cmath>

namespace hybrid_slam::window {

/// Colours, explained in doc/gui.md.
namespace colours {
inline const mrpt::img::TColor kRed{220, 0, 0}, kGreen{0, 150, 0}, kBlue{0, 70, 230}, kOrange{245, 130, 0},
    kViolet{150, 0, 180}, kLightBlue{80, 180, 255}, kBlack{0, 0, 0}, kWhite{255, 255, 255}, kGrey{80, 80, 80};
}  // namespace colours

/// Returns the point ahead of another. @param heading  rad; @param distance  m
inline mrpt::math::TPoint2D ahead(const mrpt::math::TPoint2D& from, double heading, double distance) {
  return {from.x + distance * std::cos(heading), from.y + distance * std::sin(heading)};
}

/// Shapes of one colour and pen, made of triangles: mrpt-opengl draws lines one pixel wide.
class Strokes {
 public:
  using Point = mrpt::math::TPoint2D;  ///< m, map frame

  /// @param width  pen width, m
  /// @param height  above the grid, m
  Strokes(const char* name, const mrpt::img::TColor& colour, double width, double height)
      : colour_(colour), half_(width / 2), height_(static_cast<float>(height)) {
    triangles_->setName(name);
    triangles_->enableLight(false);
  }
  void triangle(const Point& a, const Point& b, const Point& c) {
    const auto point = [&](const Point& p) {
      return mrpt::math::TPoint3Df(static_cast<float>(p.x), static_cast<float>(p.y), height_);
    };
    mrpt::opengl::TTriangle corners(point(a), point(b), point(c));
    corners.setColor(colour_);
    triangles_->insertTriangle(corners);
  }
  /// Draws a segment, extended by half the pen width at both ends so that consecutive segments join.
  void segment(const Point& a, const Point& b) {
    const double heading = std::atan2(b.y - a.y, b.x - a.x);
    const Point from = ahead(a, heading, -half_), to = ahead(b, heading, half_);
    const double left = heading + M_PI / 2;
    triangle(ahead(from, left, half_), ahead(from, left, -half_), ahead(to, left, -half_));
    triangle(ahead(from, left, half_), ahead(to, left, -half_), ahead(to, left, half_));
  }
  /// Draws a filled rectangle with sides along the axes.
  void rectangle(const Point& a, const Point& b) {
    triangle(a, {a.x, b.y}, b);
    triangle(a, b, {b.x, a.y});
  }
  /// @param a,b  semi-axes, m
  void ellipse(const Point& centre, double a, double b, double direction) {
    constexpr int kCorners = 48;
    const auto corner = [&](int i) {
      const double t = 2 * M_PI * i / kCorners;
      return ahead(ahead(centre, direction, a * std::cos(t)), direction + M_PI / 2, b * std::sin(t));
    };
    for (int i = 0; i < kCorners; ++i) segment(corner(i), corner(i + 1));
  }
  /// @param length  from the centre to the tip, m
  void arrow(const Point& centre, double heading, double length) {
    triangle(ahead(centre, heading, length), ahead(centre, heading + 2.4, 3 * length / 7),
             ahead(centre, heading - 2.4, 3 * length / 7));
  }
  const mrpt::opengl::CSetOfTriangles::Ptr& object() const { return triangles_; }

 private:
  mrpt::img::TColor colour_;
  double half_;
  float height_;
  mrpt::opengl::CSetOfTriangles::Ptr triangles_ = mrpt::opengl::CSetOfTriangles::Create();
};

}  // namespace hybrid_slam::window
