#include "study/comparison/Report.h"

#include <mrpt/maps/COccupancyGridMap2D.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <tuple>

#include "study/comparison/ParticlePlot.h"
#include "study/comparison/PlanView.h"
#include "study/comparison/Plots.h"
#include "study/comparison/ReportTables.h"
#include "study/comparison/Svg.h"
#include "study/comparison/WallErrors.h"
#include "study/evaluation/AbsoluteTrajectoryError.h"

namespace hybrid_slam::comparison {
namespace {

const char* const kHead = R"(<!DOCTYPE html>
<html xmlns="http://www.w3.org/1999/xhtml" lang="en">
<head>
<meta charset="UTF-8"/>
<meta name="viewport" content="width=device-width, initial-scale=1"/>
<title>slam-compare</title>
<style>
body { font-family: sans-serif; color: #222; line-height: 1.45; max-width: 1180px; margin: 24px auto; padding: 0 20px; }
h1 { font-size: 26px; margin-bottom: 4px; }
h2 { font-size: 19px; margin-top: 38px; border-bottom: 1px solid #ccc; padding-bottom: 4px; }
p.note { color: #555; font-size: 14px; max-width: 860px; }
pre { background: #f4f4f4; padding: 10px 12px; white-space: pre-wrap; overflow-wrap: anywhere; font-size: 13px; }
table { border-collapse: collapse; font-size: 13.5px; margin: 10px 0; }
th { background: #f0f0f0; font-weight: 600; vertical-align: bottom; max-width: 130px; }
th, td { border: 1px solid #d5d5d5; padding: 4px 7px; text-align: right; }
td:first-child, th:first-child, td.text { text-align: left; }
td small { color: #666; display: block; white-space: nowrap; }
div.wide { overflow-x: auto; }
div.plots { display: flex; flex-wrap: wrap; gap: 18px 26px; align-items: flex-start; }
svg { max-width: 100%; height: auto; }
figure { margin: 0; max-width: 540px; }
figure img { max-width: 100%; border: 1px solid #ccc; }
figcaption { font-size: 13px; color: #444; }
</style>
</head>
<body>
)";

void section(std::ostream& out, const std::string& title, const std::string& note,
             const std::string& content) {
  if (content.empty()) return;
  out << "<h2>" << escapeXml(title) << "</h2>\n<p class=\"note\">" << escapeXml(note) << "</p>\n" << content;
}

std::string plots(const std::string& content) {
  return content.empty() ? content : "<div class=\"plots\">\n" + content + "</div>\n";
}

RunFolder folderOf(const ReportInput& input, const RunResult& r) {
  return {input.runs, runName(input.groups[r.run.group], r.run.seed)};
}

std::vector<const RunResult*> finishedRuns(const ReportInput& input, size_t group) {
  std::vector<const RunResult*> runs;
  for (const RunResult& r : input.results)
    if (r.run.group == group && r.status == RunResult::Status::done) runs.push_back(&r);
  return runs;
}

void writeIntroduction(const ReportInput& input, std::ostream& out) {
  size_t done = 0, failed = 0;
  for (const GroupSummary& s : input.summaries) done += s.done, failed += s.failed;
  out << "<h1>slam-compare: " << escapeXml(std::filesystem::path(input.log).filename().string())
      << "</h1>\n<p>" << done << " finished runs";
  if (failed) out << ", " << failed << " failed";
  if (input.results.size() > done + failed) out << ", " << input.results.size() - done - failed << " missing";
  out << ": " << input.groups.size() << " groups of " << input.results.size() / input.groups.size()
      << " seeds each, on a log of " << shortNumber(input.logDuration) << " s. hybrid-slam "
      << escapeXml(input.version) << ".</p>\n<pre>" << escapeXml(input.command)
      << "</pre>\n<p class=\"note\">Settings: " << escapeXml(input.config);
  for (const std::string& setting : input.settings) out << ", " << escapeXml(setting);
  for (const Group& group : input.groups) {
    if (group.variant.name.empty() || group.particles != input.groups[0].particles) continue;
    out << "; <b>" << escapeXml(group.label()) << "</b>: ";
    if (!group.variant.iniFile.empty()) out << escapeXml(group.variant.iniFile) << " ";
    for (const std::string& setting : group.variant.settings) out << escapeXml(setting) << " ";
  }
  out << ". The number behind a name is that of the particles.</p>\n";
}

/// What success asks for; empty where nothing does.
std::string criterionNote(const GroundTruth& truth) {
  const SuccessCriterion& c = truth.criterion;
  std::vector<std::string> conditions;
  if (!truth.reference.empty()) {
    conditions.push_back(
        "from the first scan to the last the estimated motion differs from the reference's by less than " +
        shortNumber(c.returnTrans) + " m and " + shortNumber(c.returnRot) + " deg");
    if (truth.plan)
      conditions.push_back("less than " + shortNumber(100 * c.doubledShare) +
                           " % of the wall that the map shows is drawn twice");
  }
  if (!truth.relations.empty())
    conditions.push_back("the relations' mean translation error is below " + shortNumber(c.relations) + " m");
  if (truth.revisits)
    conditions.push_back("scans revisit earlier ones, up to " + shortNumber(truth.revisits->distance) +
                         " m apart, and the median of their errors is below " + shortNumber(c.revisits) +
                         " m");
  if (conditions.empty()) return {};
  std::string note = "Success: " + conditions[0];
  for (size_t i = 1; i < conditions.size(); ++i) note += "; " + conditions[i];
  return note +
         (truth.plan || truth.reference.empty() ? "."
                                                : ". Without a floor plan nothing is asked of the walls.") +
         " A run that fails has no success. The interval is Wilson's, 95 %.";
}

std::string spreadPlots(const ReportInput& input) {
  std::vector<SpreadBands> bands;
  for (size_t g = 0; g < input.groups.size(); ++g) {
    std::vector<std::vector<SpreadStep>> runs;
    for (const RunResult* r : finishedRuns(input, g))
      runs.push_back(loadSpread(folderOf(input, *r).file("steps.csv").string()));
    bands.push_back(spreadBands(runs, 300));
  }
  std::string all;
  for (size_t s = 0; s < kSpreads; ++s) all += plotSpread(s, input.groups, bands);
  return plots(all);
}

std::string trajectoryPlots(const ReportInput& input) {
  const files::Trajectory& reference = input.truth.reference;
  std::string all;
  for (size_t g = 0; g < input.groups.size(); ++g) {
    std::vector<files::Trajectory> trajectories;
    for (const RunResult* r : finishedRuns(input, g)) {
      trajectories.push_back(files::loadTum(folderOf(input, *r).file("trajectory.tum").string()));
      if (reference.empty()) continue;
      const auto alignment = evaluation::absoluteTrajectoryError(trajectories.back(), reference,
                                                                 GroundTruth::kReferenceTolerance)
                                 .alignment;
      for (files::StampedPose& p : trajectories.back()) p.pose = alignment + p.pose;
    }
    if (!trajectories.empty())
      all += plotTrajectories(g, input.groups, trajectories, reference,
                              input.truth.plan ? &*input.truth.plan : nullptr);
  }
  return plots(all);
}

/// The figure that says which run of a group is its median and which its worst; nothing without a reference.
std::optional<Figure> rankingFigure(const ReportInput& input) {
  for (const Figure figure : {Figure::ate, Figure::transMean})
    for (const RunResult& r : input.results)
      if (r[figure]) return figure;
  return std::nullopt;
}

std::string mapPicture(const ReportInput& input, const RunResult& r, const std::string& caption) {
  std::ifstream in(folderOf(input, r).file("map.png"), std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(in), {});
  if (bytes.empty()) return {};
  const std::string text =
      escapeXml(input.groups[r.run.group].name() + ", seed " + std::to_string(r.run.seed) + ": " + caption);
  return "<figure><img alt=\"map of " + text + "\" src=\"data:image/png;base64," + base64(bytes) +
         "\"/><figcaption>" + text + "</figcaption></figure>\n";
}

/// A group's finished runs from the best to the worst, where there is a figure that says so.
std::vector<const RunResult*> rankedRuns(const ReportInput& input, size_t group) {
  auto runs = finishedRuns(input, group);
  if (const auto ranking = rankingFigure(input))
    std::stable_sort(runs.begin(), runs.end(), [&](const RunResult* a, const RunResult* b) {
      return (*a)[*ranking].value_or(0) < (*b)[*ranking].value_or(0);
    });
  return runs;
}

std::string mapPictures(const ReportInput& input) {
  const auto ranking = rankingFigure(input);
  std::string all;
  for (size_t g = 0; g < input.groups.size(); ++g) {
    const auto runs = rankedRuns(input, g);
    if (runs.empty()) continue;
    if (!ranking) {
      all += mapPicture(input, *runs[0], "the first");
      continue;
    }
    const FigureName& name = kFigureNames[static_cast<size_t>(*ranking)];
    const auto caption = [&](const char* which, const RunResult& r) {
      return std::string(which) + " run, " + name.title + " " + shortNumber(r[*ranking].value_or(0), 3) +
             " " + name.unit;
    };
    const RunResult& median = *runs[(runs.size() - 1) / 2];
    all += mapPicture(input, median, caption("median", median));
    if (runs.size() > 1) all += mapPicture(input, *runs.back(), caption("worst", *runs.back()));
  }
  return plots(all);
}

/// The paper's Fig. 6: the map of each group's median run over the walls.
std::string wallPlots(const ReportInput& input) {
  if (!input.truth.plan) return {};
  std::string all;
  for (size_t g = 0; g < input.groups.size(); ++g) {
    const auto runs = rankedRuns(input, g);
    if (runs.empty()) continue;
    const RunResult& median = *runs[(runs.size() - 1) / 2];
    const RunFolder folder = folderOf(input, median);
    const auto map = loadGridMap(folder.file("map.gridmap.gz").string());
    auto cells = occupiedCells(map);
    const auto alignment =
        evaluation::absoluteTrajectoryError(files::loadTum(folder.file("trajectory.tum").string()),
                                            input.truth.reference, GroundTruth::kReferenceTolerance)
            .alignment;
    for (auto& cell : cells) cell = alignment.composePoint(cell);
    all += plotCellsOverWalls(cells, map.getResolution(), *input.truth.plan,
                              input.groups[g].name() + ": mean " +
                                  shortNumber(median[Figure::wallMean].value_or(0), 2) + " m, 95 % below " +
                                  shortNumber(median[Figure::wallP95].value_or(0), 2) + " m");
  }
  return plots(all);
}

/// The particles of each group's median run at the same moments, all at the same scale.
std::string particlePlots(const ReportInput& input) {
  constexpr size_t kMoments = 4;
  struct Shown {
    std::string name;
    std::vector<ParticleSnapshot> run;
    mrpt::math::TPose2D alignment;
  };
  std::vector<Shown> shown;
  for (size_t g = 0; g < input.groups.size(); ++g) {
    const auto runs = rankedRuns(input, g);
    if (runs.empty()) continue;
    const RunFolder folder = folderOf(input, *runs[(runs.size() - 1) / 2]);
    auto snapshots = loadParticles(folder.file("particles.csv").string());
    if (snapshots.empty()) continue;
    shown.push_back({input.groups[g].name(), std::move(snapshots), {}});
    if (!input.truth.reference.empty())
      shown.back().alignment =
          evaluation::absoluteTrajectoryError(files::loadTum(folder.file("trajectory.tum").string()),
                                              input.truth.reference, GroundTruth::kReferenceTolerance)
              .alignment;
  }
  if (shown.empty()) return {};
  const double start = shown[0].run[0].timestamp;
  const std::vector<double> moments = turningMoments(shown[0].run, kMoments);
  double farthest = 0;  // m, of any particle from its robot
  for (const Shown& s : shown)
    for (const double moment : moments)
      farthest = std::max(farthest, nearestSnapshot(s.run, moment).radius());
  std::string all;
  for (const Shown& s : shown) {
    std::string row;
    for (const double moment : moments)
      row += plotParticles(nearestSnapshot(s.run, moment), s.alignment,
                           input.truth.plan ? &*input.truth.plan : nullptr, std::max(0.2, 2.5 * farthest),
                           s.name + ", " + shortNumber(std::round(10 * (moment - start)) / 10) + " s");
    all += plots(row);
  }
  return all;
}

}  // namespace

std::string runName(const Group& group, int seed) { return group.name() + "-" + std::to_string(seed); }

std::string base64(const std::string& bytes) {
  static const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0);
    for (size_t k = 0; k < 4; ++k) out += i + k <= bytes.size() ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

void writeReport(const ReportInput& input, std::ostream& out) {
  const auto& [groups, results, summaries] = std::tie(input.groups, input.results, input.summaries);
  out << kHead;
  writeIntroduction(input, out);
  section(out, "Failed runs", "They count as runs without success and have no figures.",
          failureTable(groups, results));

  section(
      out, "Accuracy",
      "Median over the seeds, below it the quartiles; first of the successful runs alone where a group has "
      "others too. " +
          criterionNote(input.truth),
      summaryTable(
          groups, summaries,
          {Figure::ate, Figure::returnTrans, Figure::returnRot, Figure::transMean, Figure::rotMean,
           Figure::wallMean, Figure::wallP95, Figure::doubledShare, Figure::revisitMedian, Figure::revisits},
          true));
  section(out, "Success rates", "Share of the seeds that succeed.", plotSuccess(groups, summaries));
  std::string errors;
  for (const FigureName& name : kFigureNames)
    if (name.isError && (name.figure < Figure::stdAlong || name.figure > Figure::stdPhi))
      errors += plotFigure(name, groups, results);
  section(out, "Errors",
          "A dot is a run; the box reaches from the lower to the upper quartile, the bar is the median.",
          plots(errors));
  section(out, "Each group against the first",
          "Median of the group / median of " + groups[0].name() +
              " over the seeds that both have finished: below 1 the group is better. Below it the 95 % "
              "interval (percentile "
              "bootstrap over seeds), then p of Wilcoxon's signed-rank test and of the sign test over the "
              "seeds: two-sided, "
              "exact, each for itself (not corrected for their number).",
          pairedTable(groups, summaries));

  section(out, "Particle spread",
          "Weighted standard deviation of the particles before resampling; mean over the updates of a run, "
          "then median "
          "and quartiles over the seeds.",
          summaryTable(groups, summaries, {Figure::stdAlong, Figure::stdAcross, Figure::stdPhi}, false));
  section(out, "Particle spread over time",
          "Line: median over the seeds; band: quartiles. Colours stand for method and variant, dashes for "
          "the particles.",
          spreadPlots(input));

  section(
      out, "Particles",
      "Particles (red, each with its heading) and robot (light blue: the particle of the highest weight) in "
      "the median run of each group, at the moment of each quarter of the log in which the robot turned most "
      "between two snapshots.",
      particlePlots(input));
  section(
      out, "Time and memory", "Each run is a process of its own with one thread.",
      summaryTable(
          groups, summaries,
          {Figure::wallTime, Figure::cpuTime, Figure::realtimeFactor, Figure::peakMemory, Figure::lines},
          false) +
          plots(plotAgainstParticles(kFigureNames[static_cast<size_t>(Figure::cpuTime)], groups, summaries) +
                plotAgainstParticles(kFigureNames[static_cast<size_t>(Figure::peakMemory)], groups,
                                     summaries)));

  section(out, "Trajectories",
          input.truth.reference.empty()
              ? "All seeds of a group, from their common start."
              : "All seeds of a group, each rigidly aligned to the reference (black, dashed).",
          trajectoryPlots(input));
  section(out, "Maps over the walls",
          "The occupied cells of each group's median run over the floor plan (blue), the map aligned by its "
          "trajectory; their colour tells the distance to the nearest wall.",
          wallPlots(input));
  section(out, "Maps",
          "Black: occupied; red: path; green: line database; light blue: the robot at the end. Each map is "
          "in its own "
          "frame, that of the robot's first pose.",
          mapPictures(input));
  out << "</body>\n</html>\n";
}

}  // namespace hybrid_slam::comparison
