#include "study/comparison/Plots.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/RandomStream.h"
#include "study/comparison/PlanView.h"
#include "study/comparison/Svg.h"

namespace hybrid_slam::comparison {
namespace {

std::string withUnit(const FigureName& name) {
  return std::string(name.title) + (*name.unit ? std::string(" (") + name.unit + ")" : std::string());
}

/// How a group is drawn in all plots: the colour stands for method and variant, the dashes for the particles.
struct Look {
  std::string colour, dash;
  std::string stroke(double width) const {
    return "stroke:" + colour + ";" + dash + "stroke-width:" + shortNumber(width);
  }
  std::string solid(double width) const { return "stroke:" + colour + ";stroke-width:" + shortNumber(width); }
  std::string fill(double opacity) const {
    return "fill:" + colour + ";fill-opacity:" + shortNumber(opacity);
  }
};

std::vector<Look> looksOf(const std::vector<Group>& groups) {
  std::vector<std::string> labels;
  std::map<int, size_t> particles;
  for (const Group& group : groups) {
    if (std::find(labels.begin(), labels.end(), group.label()) == labels.end())
      labels.push_back(group.label());
    particles.emplace(group.particles, particles.size());
  }
  std::vector<Look> looks;
  for (const Group& group : groups) {
    const auto label = std::find(labels.begin(), labels.end(), group.label()) - labels.begin();
    looks.push_back({plotColour(static_cast<size_t>(label)), plotDash(particles.at(group.particles))});
  }
  return looks;
}

/// Rows of colour and name to the right of the plot.
void drawLegend(Svg& svg, Point at, const std::vector<std::pair<std::string, std::string>>& entries) {
  for (const auto& [style, name] : entries) {
    svg.line(at, {at.x + 26, at.y}, style);
    svg.text({at.x + 33, at.y + 4}, name);
    at.y += 18;
  }
}

double legendWidth(const std::vector<Group>& groups) {
  size_t longest = 0;
  for (const Group& group : groups) longest = std::max(longest, group.name().size());
  return 48 + 7.2 * static_cast<double>(longest);
}

struct Range {
  double low = INFINITY, high = -INFINITY;
  void add(double value) { low = std::min(low, value), high = std::max(high, value); }
  bool isEmpty() const { return low > high; }
  /// Errors of runs that went well and of those that did not lie decades apart.
  bool wantsLogarithm() const { return low > 0 && high / low > 20; }
};

/// From zero unless the values spread over decades.
Axis verticalAxis(const Range& range, const Frame& f) {
  const bool isLogarithmic = range.wantsLogarithm();
  return {isLogarithmic ? range.low : std::min(0.0, range.low), range.high,
          isLogarithmic ? Axis::Kind::logarithmic : Axis::Kind::linear, f.bottom, f.top};
}

}  // namespace

std::string plotFigure(const FigureName& name, const std::vector<Group>& groups,
                       const std::vector<RunResult>& results) {
  std::vector<std::vector<double>> values(groups.size());
  Range range;
  for (const RunResult& r : results)
    if (const auto& value = r[name.figure]) values[r.run.group].push_back(*value), range.add(*value);
  if (range.isEmpty()) return {};

  size_t longest = 0;
  for (const Group& group : groups) longest = std::max(longest, group.label().size());
  const double column = std::max(60.0, 6.6 * static_cast<double>(longest) + 10);
  const Frame f{64, 30, 64 + column * static_cast<double>(groups.size()), 250};
  Svg svg(std::max(f.right + 10, 330.0), 300);
  svg.text({f.left, 16}, withUnit(name), Anchor::start, "font-weight:bold");
  const Axis y = verticalAxis(range, f);
  drawYAxis(svg, f, y, *name.unit ? name.unit : "share");
  const std::vector<Look> looks = looksOf(groups);
  for (size_t g = 0; g < groups.size(); ++g) {
    const double centre = f.left + column * (static_cast<double>(g) + 0.5),
                 half = std::min(column * 0.3, 34.0);
    svg.text({centre, f.bottom + 17}, groups[g].label(), Anchor::middle);
    svg.text({centre, f.bottom + 33}, std::to_string(groups[g].particles) + " p.", Anchor::middle,
             "fill:#666");
    if (values[g].empty()) {
      svg.text({centre, (f.top + f.bottom) / 2}, "no run", Anchor::middle, "fill:#666");
      continue;
    }
    const Quartiles q = quartiles(values[g]);
    svg.rectangle({centre - half, y.pixel(q.upper)}, 2 * half, y.pixel(q.lower) - y.pixel(q.upper),
                  looks[g].fill(0.15) + ";" + looks[g].solid(1));
    svg.line({centre - half, y.pixel(q.median)}, {centre + half, y.pixel(q.median)}, looks[g].solid(3));
    for (size_t i = 0; i < values[g].size(); ++i) {
      const double aside = (RandomStream(1, g, i).uniform() - 0.5) * half;
      svg.circle({centre + aside, y.pixel(values[g][i])}, 2.6, looks[g].fill(0.7), shortNumber(values[g][i]));
    }
  }
  svg.line({f.left, f.bottom}, {f.right, f.bottom}, "stroke:#888;stroke-width:1");
  return svg.str(withUnit(name));
}

std::string plotSuccess(const std::vector<Group>& groups, const std::vector<GroupSummary>& summaries) {
  if (summaries.empty() || !summaries[0].successes) return {};
  const double row = 26, names = legendWidth(groups);
  const Frame f{names, 12, names + 480, 12 + row * static_cast<double>(groups.size())};
  Svg svg(f.right + 110, f.bottom + 44);
  const Axis x(0, 100, Axis::Kind::linear, f.left, f.right);
  const std::vector<Look> looks = looksOf(groups);
  for (const double tick : x.ticks())
    svg.line({x.pixel(tick), f.top}, {x.pixel(tick), f.bottom}, "stroke:#ddd;stroke-width:1");
  drawXAxis(svg, f, x, "successful runs (%), and 95 % interval");
  for (size_t g = 0; g < groups.size(); ++g) {
    const GroupSummary& s = summaries[g];
    const double y = f.top + row * (static_cast<double>(g) + 0.5);
    svg.text({f.left - 8, y + 4}, groups[g].name(), Anchor::end);
    if (s.ended() == 0) continue;
    const double low = x.pixel(100 * s.successInterval.low), high = x.pixel(100 * s.successInterval.high);
    svg.line({low, y}, {high, y}, looks[g].solid(2));
    for (const double end : {low, high}) svg.line({end, y - 5}, {end, y + 5}, looks[g].solid(2));
    svg.circle({x.pixel(100 * s.successRate), y}, 5, looks[g].fill(1));
    svg.text({f.right + 10, y + 4}, std::to_string(*s.successes) + " of " + std::to_string(s.ended()));
  }
  return svg.str("success rates");
}

std::string plotAgainstParticles(const FigureName& name, const std::vector<Group>& groups,
                                 const std::vector<GroupSummary>& summaries) {
  const auto f0 = static_cast<size_t>(name.figure);
  Range range, particles;
  for (size_t g = 0; g < groups.size(); ++g)
    if (const auto& q = summaries[g].figures[f0].quartiles)
      range.add(q->lower), range.add(q->upper), particles.add(groups[g].particles);
  if (range.isEmpty()) return {};

  const Frame f{64, 30, 380, 240};
  Svg svg(f.right + 20 + legendWidth(groups), 285);
  svg.text({f.left, 16}, withUnit(name), Anchor::start, "font-weight:bold");
  range.add(0);
  const Axis y = verticalAxis(range, f), x(0, particles.high, Axis::Kind::linear, f.left, f.right);
  drawYAxis(svg, f, y, name.unit);
  drawXAxis(svg, f, x, "particles");
  const std::vector<Look> looks = looksOf(groups);
  std::vector<std::pair<std::string, std::string>> legend;
  std::map<std::string, std::vector<Point>> lines;  // medians by colour
  for (size_t g = 0; g < groups.size(); ++g) {
    const std::string style = looks[g].solid(2);
    if (lines.count(style) == 0) legend.emplace_back(style, groups[g].label());
    auto& line = lines[style];
    const auto& q = summaries[g].figures[f0].quartiles;
    if (!q) continue;
    const double px = x.pixel(groups[g].particles);
    line.push_back({px, y.pixel(q->median)});
    svg.line({px, y.pixel(q->lower)}, {px, y.pixel(q->upper)}, looks[g].solid(1.5));
    svg.circle(line.back(), 4, looks[g].fill(1), groups[g].name() + ": " + shortNumber(q->median));
  }
  for (auto& [style, line] : lines) {
    std::sort(line.begin(), line.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
    svg.polyline(line, style);
  }
  drawLegend(svg, {f.right + 20, f.top + 8}, legend);
  return svg.str(withUnit(name) + " against particles");
}

std::string plotSpread(size_t spread, const std::vector<Group>& groups,
                       const std::vector<SpreadBands>& bands) {
  const char* const titles[] = {"spread along the heading (m)", "spread across the heading (m)",
                                "spread of the heading (deg)", "spread in x (m)", "spread in y (m)"};
  const char* const units[] = {"m", "m", "deg", "m", "m"};
  Range range, times;
  for (const SpreadBands& band : bands) {
    for (const double t : band.times) times.add(t);
    for (const Quartiles& q : band.bands[spread]) range.add(q.upper);
  }
  if (times.isEmpty()) return {};
  range.add(0);
  const Frame f{64, 30, 820, 230};
  Svg svg(f.right + 20 + legendWidth(groups), 275);
  svg.text({f.left, 16}, titles[spread], Anchor::start, "font-weight:bold");
  const Axis y(0, range.high, Axis::Kind::linear, f.bottom, f.top);
  const Axis x(0, times.high, Axis::Kind::tight, f.left, f.right);
  drawYAxis(svg, f, y, units[spread]);
  drawXAxis(svg, f, x, "time since the first update (s)");
  const std::vector<Look> looks = looksOf(groups);
  std::vector<std::pair<std::string, std::string>> legend;
  for (size_t g = 0; g < groups.size(); ++g) {
    const auto& quartilesOverTime = bands[g].bands[spread];
    std::vector<Point> upper, lower, median;
    for (size_t i = 0; i < bands[g].times.size(); ++i) {
      const double px = x.pixel(bands[g].times[i]);
      upper.push_back({px, y.pixel(quartilesOverTime[i].upper)});
      lower.push_back({px, y.pixel(quartilesOverTime[i].lower)});
      median.push_back({px, y.pixel(quartilesOverTime[i].median)});
    }
    std::vector<Point> band = upper;
    band.insert(band.end(), lower.rbegin(), lower.rend());
    if (!band.empty()) svg.polygon(band, looks[g].fill(0.12));
    if (!median.empty()) svg.polyline(median, looks[g].stroke(1.6));
    legend.emplace_back(looks[g].stroke(2), groups[g].name());
  }
  drawLegend(svg, {f.right + 20, f.top + 8}, legend);
  return svg.str(titles[spread]);
}

std::string plotTrajectories(size_t group, const std::vector<Group>& groups,
                             const std::vector<files::Trajectory>& trajectories,
                             const files::Trajectory& reference, const simulation::FloorPlan* plan) {
  Range xs, ys;
  const auto take = [&](double x, double y) { xs.add(x), ys.add(y); };
  for (const files::StampedPose& p : reference) take(p.pose.x, p.pose.y);
  for (const files::Trajectory& trajectory : trajectories)
    for (const files::StampedPose& p : trajectory) take(p.pose.x, p.pose.y);
  if (plan) take(plan->lowerLeft().x, plan->lowerLeft().y), take(plan->upperRight().x, plan->upperRight().y);
  if (xs.isEmpty()) return {};

  constexpr double kSide = 380, kMargin = 24;
  const double scale = kSide / std::max({xs.high - xs.low, ys.high - ys.low, 1.0});
  Svg svg(std::max((xs.high - xs.low) * scale, 200.0) + 2 * kMargin,
          (ys.high - ys.low) * scale + 2 * kMargin + 26);
  const std::string title = groups[group].name();
  svg.text({kMargin, 15}, title, Anchor::start, "font-weight:bold");
  const PlanView view({xs.low, ys.high}, {kMargin, kMargin}, scale);
  const auto draw = [&](const files::Trajectory& trajectory, const std::string& style) {
    std::vector<Point> points;
    for (const files::StampedPose& p : trajectory) {
      const Point next = view.pixel({p.pose.x, p.pose.y});
      const bool isLast = &p == &trajectory.back();
      if (points.empty() || isLast || std::hypot(next.x - points.back().x, next.y - points.back().y) >= 1)
        points.push_back(next);
    }
    svg.polyline(points, style);
  };
  if (plan) view.drawWalls(svg, *plan, "stroke:#bbb;stroke-width:1");
  const std::string style = looksOf(groups)[group].solid(0.8) + ";stroke-opacity:0.6";
  for (const files::Trajectory& trajectory : trajectories) draw(trajectory, style);
  if (!reference.empty()) draw(reference, "stroke:#000;stroke-width:1.4;stroke-dasharray:5 3");
  view.drawScaleBar(svg, {kMargin, svg.height() - 12}, 100);
  return svg.str("trajectories of " + title);
}

}  // namespace hybrid_slam::comparison
