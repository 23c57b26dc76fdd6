#include "study/comparison/Plots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "study/comparison/ReportText.h"

namespace hybrid_slam::comparison {
namespace {

std::string withUnit(const FigureName& name) {
  return std::string(name.title) + (*name.unit ? std::string(" (") + name.unit + ")" : std::string());
}

/// gnuplot's dash type for each group's particle count.
std::vector<size_t> dashesOf(const std::vector<Group>& groups) {
  std::map<int, size_t> particles;
  for (const Group& group : groups) particles.emplace(group.particles, particles.size());
  std::vector<size_t> dashes;
  for (const Group& group : groups) dashes.push_back(particles.at(group.particles) % 5 + 1);
  return dashes;
}

size_t longest(const std::vector<Group>& groups, std::string (Group::*name)() const) {
  size_t length = 0;
  for (const Group& group : groups) length = std::max(length, (group.*name)().size());
  return length;
}

struct Range {
  double low = INFINITY, high = -INFINITY;
  void add(double value) { low = std::min(low, value), high = std::max(high, value); }
  bool isEmpty() const { return low > high; }
};

/// Starts the axis at zero, unless the values span decades, like the errors of runs that close the loop and
/// runs that do not.
std::string verticalAxis(const Range& range) {
  if (range.low <= 0 || range.high / range.low <= 20)
    return "set yrange [" + shortNumber(std::min(0.0, range.low)) + ":" + (range.high > 0 ? "*" : "1") +
           "]\n";
  return "set logscale y\nset ytics ()\n"
         "set for [e=-9:9] for [f in '1 2 5'] ytics add (sprintf('%g', f * 10.0**e) f * 10.0**e)\n"
         "set yrange [" +
         shortNumber(range.low / 1.2) + ":" + shortNumber(range.high * 1.2) + "]\n";
}

std::string title(const std::string& text) { return "set title " + gnuplotText(text) + " offset 0,-0.3\n"; }

}  // namespace

std::vector<int> plotColours(const std::vector<Group>& groups) {
  static constexpr std::array<int, 7> kColours{0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7,
                                               0xe69f00, 0x56b4e9, 0x555555};
  std::map<std::string, size_t> labels;
  for (const Group& group : groups) labels.emplace(group.label(), labels.size());
  std::vector<int> colours;
  for (const Group& group : groups) colours.push_back(kColours[labels.at(group.label()) % kColours.size()]);
  return colours;
}

Plot plotFigure(const FigureName& name, const std::vector<Group>& groups,
                const std::vector<RunResult>& results) {
  const std::vector<int> colours = plotColours(groups);
  std::vector<std::vector<double>> values(groups.size());
  Range range;
  DataBlock dots("dots"), boxes("boxes");
  for (const RunResult& r : results)
    if (const auto& value = r[name.figure]) {
      const size_t g = r.run.group;
      values[g].push_back(*value);
      range.add(*value);
      dots.add({static_cast<double>(g), *value, static_cast<double>(colours[g])});
    }
  if (range.isEmpty()) return {};

  std::string tics, labels;
  for (size_t g = 0; g < groups.size(); ++g) {
    tics += (g ? ", " : "") + gnuplotText(groups[g].label()) + ".\"\\n\"." +
            gnuplotText(std::to_string(groups[g].particles) + " p.") + " " + std::to_string(g);
    if (values[g].empty()) {
      labels += "set label 'no run' at first " + std::to_string(g) + ", graph 0.5 center\n";
      continue;
    }
    const Quartiles q = quartiles(values[g]);
    boxes.add({static_cast<double>(g), q.lower, q.median, q.upper, static_cast<double>(colours[g])});
  }
  const double column = std::max(60.0, 6.6 * static_cast<double>(longest(groups, &Group::label)) + 10);
  const auto width = static_cast<int>(90 + column * static_cast<double>(groups.size()));
  return {withUnit(name), std::max(width, 340), 300,
          title(withUnit(name)) + verticalAxis(range) + dots.script() + boxes.script() + labels +
              "set xrange [-0.5:" + shortNumber(static_cast<double>(groups.size()) - 0.5) + "]\nset xtics (" +
              tics + ") scale 0\nset bmargin 3.5\nset grid noxtics\nset ylabel " +
              gnuplotText(*name.unit ? name.unit : "share") +
              "\nset style fill transparent solid 0.15 border\nset jitter overlap 0.5 spread 0.4\n"
              "plot $boxes using 1:3:($1-0.3):($1+0.3):2:4:5 with boxxyerror linecolor rgb variable notitle, "
              "$boxes using ($1-0.3):3:(0.6):(0):5 with vectors nohead linewidth 3 linecolor rgb variable "
              "notitle, "
              "$dots with points pointtype 7 pointsize 0.5 linecolor rgb variable notitle\n"};
}

Plot plotSuccess(const std::vector<Group>& groups, const std::vector<GroupSummary>& summaries) {
  if (summaries.empty() || !summaries[0].successes) return {};
  const std::vector<int> colours = plotColours(groups);
  DataBlock rates("rates");
  std::string names, counts;
  for (size_t g = 0; g < groups.size(); ++g) {
    const GroupSummary& s = summaries[g];
    const std::string separator = g ? ", " : "", at = " " + std::to_string(g);
    names += separator + gnuplotText(groups[g].name()) + at;
    counts += separator +
              gnuplotText(std::to_string(s.successes.value_or(0)) + " of " + std::to_string(s.ended())) + at;
    if (s.ended() > 0)
      rates.add({100 * s.successRate, static_cast<double>(g), 100 * s.successInterval.low,
                 100 * s.successInterval.high, static_cast<double>(colours[g])});
  }
  return {
      "success rates", static_cast<int>(620 + 7.2 * static_cast<double>(longest(groups, &Group::name))),
      static_cast<int>(70 + 26 * groups.size()),
      rates.script() + "set xrange [0:100]\nset yrange [" +
          shortNumber(static_cast<double>(groups.size()) - 0.5) + ":-0.5]\nset ytics (" + names +
          ") scale 0\nset y2range [" + shortNumber(static_cast<double>(groups.size()) - 0.5) +
          ":-0.5]\nset y2tics (" + counts +
          ") scale 0\nset grid noytics\nset xlabel 'successful runs (%), and 95 % interval'\nset bars 2\n"
          "plot $rates with xerrorbars pointtype 7 pointsize 1 linewidth 2 linecolor rgb variable notitle\n"};
}

Plot plotAgainstParticles(const FigureName& name, const std::vector<Group>& groups,
                          const std::vector<GroupSummary>& summaries) {
  std::map<std::string, std::map<int, Quartiles>> lines;  // by label and particles
  Range range;
  range.add(0);
  for (size_t g = 0; g < groups.size(); ++g)
    if (const auto& q = summaries[g].figures[static_cast<size_t>(name.figure)].quartiles) {
      range.add(q->upper);
      lines[groups[g].label()][groups[g].particles] = *q;
    }
  if (lines.empty()) return {};

  const std::vector<int> colours = plotColours(groups);
  std::string blocks, curves;
  for (size_t g = 0; g < groups.size(); ++g) {
    const auto line = lines.find(groups[g].label());
    if (line == lines.end()) continue;
    const std::string block = "line" + std::to_string(g);
    DataBlock medians(block);
    for (const auto& [particles, q] : line->second)
      medians.add({static_cast<double>(particles), q.median, q.lower, q.upper});
    blocks += medians.script();
    const std::string look = " linewidth 2 linecolor rgb " + std::to_string(colours[g]);
    curves += (curves.empty() ? "$" : ", $") + block + " with yerrorbars pointtype 7 pointsize 0.7" + look +
              " notitle, $" + block + " with lines" + look + " title " + gnuplotText(groups[g].label());
    lines.erase(line);
  }
  return {withUnit(name) + " against particles",
          static_cast<int>(440 + 7.2 * static_cast<double>(longest(groups, &Group::label))), 285,
          title(withUnit(name)) + verticalAxis(range) + blocks +
              "set xrange [0:*]\nset offsets 0, graph 0.05, 0, 0\nset xlabel 'particles'\nset ylabel " +
              gnuplotText(name.unit) + "\nset key outside right top reverse Left\nplot " + curves + "\n"};
}

Plot plotSpread(size_t spread, const std::vector<Group>& groups, const std::vector<SpreadBands>& bands) {
  const char* const titles[] = {"spread along the heading (m)", "spread across the heading (m)",
                                "spread of the heading (deg)", "spread in x (m)", "spread in y (m)"};
  const char* const units[] = {"m", "m", "deg", "m", "m"};
  const std::vector<int> colours = plotColours(groups);
  const std::vector<size_t> dashes = dashesOf(groups);
  std::string blocks, areas, curves;
  for (size_t g = 0; g < groups.size(); ++g) {
    if (bands[g].times.empty()) continue;
    const std::string block = "band" + std::to_string(g);
    DataBlock quartilesOverTime(block);
    for (size_t i = 0; i < bands[g].times.size(); ++i) {
      const Quartiles& q = bands[g].bands[spread][i];
      quartilesOverTime.add({bands[g].times[i], q.lower, q.median, q.upper});
    }
    blocks += quartilesOverTime.script();
    const std::string colour = " linecolor rgb " + std::to_string(colours[g]);
    areas += "$" + block + " using 1:2:4 with filledcurves" + colour + " notitle, ";
    curves += (curves.empty() ? "$" : ", $") + block + " using 1:3 with lines linewidth 1.6 dashtype " +
              std::to_string(dashes[g]) + colour + " title " + gnuplotText(groups[g].name());
  }
  if (curves.empty()) return {};
  return {
      titles[spread], static_cast<int>(880 + 7.2 * static_cast<double>(longest(groups, &Group::name))), 275,
      title(titles[spread]) + blocks +
          "set xrange [0:*] noextend\nset yrange [0:*]\nset xlabel 'time since the first update (s)'\nset "
          "ylabel " +
          gnuplotText(units[spread]) +
          "\nset key outside right top reverse Left\nset style fill transparent solid 0.12 noborder\nplot " +
          areas + curves + "\n"};
}

}  // namespace hybrid_slam::comparison
