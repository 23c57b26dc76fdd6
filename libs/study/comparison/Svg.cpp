#include "study/comparison/Svg.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/Numbers.h"

namespace hybrid_slam::comparison {
namespace {

std::string pixels(double value) { return shortNumber(std::round(value * 10) / 10, 7); }

std::string at(const char* x, const char* y, Point p) {
  return std::string(x) + "=\"" + pixels(p.x) + "\" " + y + "=\"" + pixels(p.y) + "\" ";
}

std::string pointList(const std::vector<Point>& points) {
  std::string list;
  for (const Point& p : points) list += pixels(p.x) + "," + pixels(p.y) + " ";
  if (!list.empty()) list.pop_back();
  return list;
}

std::string styled(const std::string& style) { return "style=\"" + style + "\"/>\n"; }

std::string closed(const std::string& text) { return ">" + escapeXml(text) + "</text>\n"; }

/// 1, 2 or 5 times a power of ten, so that `span` holds about `count` of them.
double niceStep(double span, int count) {
  const double raw = span / count, power = std::pow(10, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (raw <= factor * power * (1 + 1e-9)) return factor * power;
  return 10 * power;
}

}  // namespace

std::string escapeXml(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (static_cast<unsigned char>(c) < 32 && c != '\n' && c != '\t')
      out += '?';  // no other control character may stand in XML
    else
      out += c;
  }
  return out;
}

std::string shortNumber(double value, int digits) {
  return numberText(value == 0 ? 0.0 : value, std::chars_format::general, digits);
}

void Svg::line(Point a, Point b, const std::string& style) {
  body_ += "<line " + at("x1", "y1", a) + at("x2", "y2", b) + styled(style);
}

void Svg::polyline(const std::vector<Point>& points, const std::string& style) {
  body_ += "<polyline points=\"" + pointList(points) + "\" " + styled("fill:none;" + style);
}

void Svg::polygon(const std::vector<Point>& points, const std::string& style) {
  body_ += "<polygon points=\"" + pointList(points) + "\" " + styled(style);
}

void Svg::rectangle(Point corner, double width, double height, const std::string& style) {
  body_ += "<rect " + at("x", "y", corner) + at("width", "height", {width, height}) + styled(style);
}

void Svg::squares(const std::vector<Point>& centres, double side, const std::string& style) {
  if (centres.empty()) return;
  const std::string length = pixels(side);
  body_ += "<path d=\"";
  for (const Point& c : centres)
    body_ += "M" + pixels(c.x - side / 2) + " " + pixels(c.y - side / 2) + "h" + length + "v" + length +
             "h-" + length + "z";
  body_ += "\" " + styled(style);
}

void Svg::circle(Point centre, double radius, const std::string& style, const std::string& title) {
  body_ += "<circle " + at("cx", "cy", centre) + "r=\"" + pixels(radius) + "\" style=\"" + style + "\"" +
           (title.empty() ? "/>\n" : "><title>" + escapeXml(title) + "</title></circle>\n");
}

void Svg::text(Point p, const std::string& text, Anchor anchor, const std::string& style) {
  const char* const names[] = {"start", "middle", "end"};
  body_ += "<text " + at("x", "y", p) + "text-anchor=\"" + names[static_cast<int>(anchor)] + "\"" +
           (style.empty() ? "" : " style=\"" + style + "\"") + closed(text);
}

void Svg::upwardsText(Point p, const std::string& text) {
  body_ += "<text " + at("x", "y", p) + "text-anchor=\"middle\" transform=\"rotate(-90 " + pixels(p.x) + " " +
           pixels(p.y) + ")\"" + closed(text);
}

std::string Svg::str(const std::string& description) const {
  const std::string width = pixels(width_), height = pixels(height_), label = escapeXml(description);
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-label=\"" + label + "\" width=\"" +
         width + "\" height=\"" + height + "\" viewBox=\"0 0 " + width + " " + height +
         "\" font-family=\"sans-serif\" font-size=\"12\" fill=\"#333\">\n" + body_ + "</svg>\n";
}

Axis::Axis(double low, double high, Kind kind, double from, double to)
    : low_(low), high_(high), kind_(kind), from_(from), to_(to) {
  if (kind_ == Kind::logarithmic) {
    const double margin = std::pow(high_ / low_, 0.05);
    low_ /= margin, high_ *= margin;
    const bool isWide = high_ / low_ > 100;
    for (double decade = std::pow(10, std::floor(std::log10(low_))); decade <= high_; decade *= 10)
      for (const double factor : {1.0, 2.0, 5.0})
        if ((factor == 1 || !isWide) && decade * factor >= low_ && decade * factor <= high_)
          ticks_.push_back(decade * factor);
    return;
  }
  if (high_ <= low_) high_ = low_ + (low_ == 0 ? 1 : std::abs(low_));
  const double step = niceStep(high_ - low_, 5), hair = 1e-9;
  if (kind_ == Kind::linear) {
    low_ = step * std::floor(low_ / step + hair);
    high_ = step * std::ceil(high_ / step - hair);
  }
  for (double i = std::ceil(low_ / step - hair); i * step <= high_ + step * hair; ++i)
    ticks_.push_back(i * step);
}

double Axis::pixel(double value) const {
  const double share = kind_ == Kind::logarithmic
                           ? std::log(std::max(value, low_) / low_) / std::log(high_ / low_)
                           : (value - low_) / (high_ - low_);
  return from_ + share * (to_ - from_);
}

namespace {
const char* const kGrid = "stroke:#ddd;stroke-width:1";
const char* const kAxisLine = "stroke:#888;stroke-width:1";
}  // namespace

void drawYAxis(Svg& svg, const Frame& f, const Axis& axis, const std::string& title) {
  for (const double tick : axis.ticks()) {
    const double y = axis.pixel(tick);
    svg.line({f.left, y}, {f.right, y}, kGrid);
    svg.text({f.left - 6, y + 4}, shortNumber(tick), Anchor::end);
  }
  svg.line({f.left, f.top}, {f.left, f.bottom}, kAxisLine);
  svg.upwardsText({f.left - 46, (f.top + f.bottom) / 2}, title);
}

void drawXAxis(Svg& svg, const Frame& f, const Axis& axis, const std::string& title) {
  for (const double tick : axis.ticks()) {
    const double x = axis.pixel(tick);
    svg.line({x, f.bottom}, {x, f.bottom + 4}, kAxisLine);
    svg.text({x, f.bottom + 17}, shortNumber(tick), Anchor::middle);
  }
  svg.line({f.left, f.bottom}, {f.right, f.bottom}, kAxisLine);
  svg.text({(f.left + f.right) / 2, f.bottom + 34}, title, Anchor::middle);
}

std::string plotColour(size_t number) {
  static const std::array<const char*, 7> colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                  "#e69f00", "#56b4e9", "#555555"};
  return colours[number % colours.size()];
}

std::string plotDash(size_t number) {
  static const std::array<const char*, 4> dashes{"", "stroke-dasharray:6 3;", "stroke-dasharray:2 2;",
                                                 "stroke-dasharray:8 3 2 3;"};
  return dashes[number % dashes.size()];
}

}  // namespace hybrid_slam::comparison
