#include "study/comparison/Report.h"

#include <tuple>

#include "study/comparison/MapPictures.h"
#include "study/comparison/Plots.h"
#include "study/comparison/ReportPlots.h"
#include "study/comparison/ReportTables.h"
#include "study/comparison/ReportText.h"

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
  out << ". The number after a name is the number of particles.</p>\n";
}

/// Text of the success criterion; empty without one.
std::string criterionNote(const GroundTruth& truth) {
  const SuccessCriterion& c = truth.criterion;
  std::vector<std::string> conditions;
  if (!truth.reference.empty()) {
    conditions.push_back(
        "the motion from the first to the last scan differs from the reference by less than " +
        shortNumber(c.returnTrans) + " m and " + shortNumber(c.returnRot) + " deg");
    if (truth.plan)
      conditions.push_back("less than " + shortNumber(100 * c.doubledShare) +
                           " % of the mapped wall is doubled");
  }
  if (!truth.relations.empty())
    conditions.push_back("the mean translation error of the relations is below " + shortNumber(c.relations) +
                         " m");
  if (truth.revisits)
    conditions.push_back("scans revisit earlier ones, up to " + shortNumber(truth.revisits->distance) +
                         " m apart, with a median error below " + shortNumber(c.revisits) + " m");
  if (conditions.empty()) return {};
  std::string note = "Success: " + conditions[0];
  for (size_t i = 1; i < conditions.size(); ++i) note += "; " + conditions[i];
  return note +
         (truth.plan || truth.reference.empty() ? "." : ". Without a floor plan the walls are not tested.") +
         " A failed run is not a success. Intervals: Wilson, 95 %.";
}

}  // namespace

std::string writeReport(const ReportInput& input, std::ostream& out) {
  Gnuplot gnuplot;
  const auto drawn = [&gnuplot](const std::vector<Plot>& all) { return plots(gnuplot.draw(all)); };
  const auto& [groups, results, summaries] = std::tie(input.groups, input.results, input.summaries);
  out << kHead;
  writeIntroduction(input, out);
  section(out, "Failed runs", "They count as unsuccessful and have no figures.",
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
  section(out, "Success rates", "Share of the seeds that succeed.", drawn({plotSuccess(groups, summaries)}));
  std::vector<Plot> errors;
  for (const FigureName& name : kFigureNames)
    if (name.isError && (name.figure < Figure::stdAlong || name.figure > Figure::stdPhi))
      errors.push_back(plotFigure(name, groups, results));
  section(out, "Errors",
          "A dot is a run; the box reaches from the lower to the upper quartile, the bar is the median.",
          drawn(errors));
  section(out, "Each group against the first",
          "Median of the group / median of " + groups[0].name() +
              " over the seeds that both finished; below 1 the group is better. Below: 95 % interval "
              "(percentile bootstrap over seeds), then p of Wilcoxon's signed-rank test and of the sign test "
              "over the seeds (two-sided, exact, not corrected for multiple tests).",
          pairedTable(groups, summaries));

  section(out, "Particle spread",
          "Weighted standard deviation of the particles before resampling: mean over the updates of a run, "
          "then median and quartiles over the seeds.",
          summaryTable(groups, summaries, {Figure::stdAlong, Figure::stdAcross, Figure::stdPhi}, false));
  section(out, "Particle spread over time",
          "Line: median over the seeds; band: quartiles. Colours stand for method and variant, dashes for "
          "the particles.",
          drawn(spreadPlots(input)));

  std::string particles;
  for (const std::vector<Plot>& group : particlePlots(input)) particles += drawn(group);
  section(
      out, "Particles",
      "Particles (red, each with its heading) and robot (light blue: the particle of the highest weight) in "
      "the median run of each group, at the moment of each quarter of the log in which the robot turned most "
      "between two snapshots.",
      particles);
  section(
      out, "Time and memory", "Each run is a separate process with one thread.",
      summaryTable(
          groups, summaries,
          {Figure::wallTime, Figure::cpuTime, Figure::realtimeFactor, Figure::peakMemory, Figure::lines},
          false) +
          drawn({plotAgainstParticles(kFigureNames[static_cast<size_t>(Figure::cpuTime)], groups, summaries),
                 plotAgainstParticles(kFigureNames[static_cast<size_t>(Figure::peakMemory)], groups,
                                      summaries)}));

  section(out, "Trajectories",
          input.truth.reference.empty()
              ? "All seeds of a group, from their common start."
              : "All seeds of a group, each rigidly aligned to the reference (black, dashed).",
          drawn(trajectoryPlots(input)));
  section(out, "Maps over the walls",
          "The occupied cells of each group's median run over the floor plan (blue), the map aligned by its "
          "trajectory; their colour shows the distance to the nearest wall.",
          drawn(wallPlots(input)));
  section(
      out, "Maps",
      "Black: occupied; red: path; green: line database; light blue: the robot at the end. Each map is in "
      "its own frame, that of the robot's first pose. The full pictures are runs/*/map.png.",
      plots(mapPictures(input)));
  if (!gnuplot.error().empty())
    out << "<p class=\"note\">Without plots: " << escapeXml(gnuplot.error()) << "</p>\n";
  out << "</body>\n</html>\n";
  return gnuplot.error();
}

}  // namespace hybrid_slam::comparison
