#include "study/comparison/ReportTables.h"

#include <cmath>

#include "study/comparison/ReportText.h"

namespace hybrid_slam::comparison {
namespace {

const char* const kNothing = "&#8211;";

std::string td(const std::string& text) { return "<td>" + text + "</td>"; }
std::string th(const std::string& text) { return "<th>" + text + "</th>"; }

std::string range(double low, double high) {
  return " <small>" + shortNumber(low, 3) + "&#160;&#8211;&#160;" + shortNumber(high, 3) + "</small>";
}

std::string percent(double share) { return shortNumber(std::round(1000 * share) / 10, 4); }

std::string successCell(const GroupSummary& s) {
  if (s.ended() == 0) return kNothing;
  return std::to_string(*s.successes) + "&#160;of&#160;" + std::to_string(s.ended()) + " <small>" +
         percent(s.successInterval.low) + "&#160;&#8211;&#160;" + percent(s.successInterval.high) +
         "&#160;%</small>";
}

/// @param withSuccess  start with the median of the successful runs if some failed
std::string figureCell(const GroupSummary& s, Figure figure, bool withSuccess) {
  const FigureSummary& f = s.figures[static_cast<size_t>(figure)];
  if (!f.quartiles) return kNothing;
  const std::string median = shortNumber(f.quartiles->median, 3);
  const std::string quartiles = range(f.quartiles->lower, f.quartiles->upper);
  if (!withSuccess || !s.hasSuccessesAndFailures() || !f.successfulMedian) return median + quartiles;
  return shortNumber(*f.successfulMedian, 3) + " <small>of " + std::to_string(f.successfulRuns) +
         (f.successfulRuns == 1 ? " success" : " successes") + "</small> <small>all " + median + "</small>" +
         quartiles;
}

std::string pValue(double p) { return p < 0.001 ? "&lt;0.001" : shortNumber(p, 2); }

const FigureName& nameOf(Figure figure) { return kFigureNames[static_cast<size_t>(figure)]; }

std::string heading(Figure figure) {
  const FigureName& name = nameOf(figure);
  return escapeXml(name.title) + (*name.unit ? std::string(" (") + name.unit + ")" : std::string());
}

}  // namespace

std::string summaryTable(const std::vector<Group>& groups, const std::vector<GroupSummary>& summaries,
                         const std::vector<Figure>& figures, bool withSuccess) {
  std::vector<Figure> shown;
  for (const Figure figure : figures)
    for (const GroupSummary& s : summaries)
      if (s.figures[static_cast<size_t>(figure)].quartiles) {
        shown.push_back(figure);
        break;
      }
  withSuccess = withSuccess && !summaries.empty() && summaries[0].successes;
  if (shown.empty() && !withSuccess) return {};

  std::string table = "<div class=\"wide\"><table>\n<tr>" + th("method") + th("particles");
  if (withSuccess) table += th("success");
  table += th("runs");
  for (const Figure figure : shown) table += th(heading(figure));
  table += "</tr>\n";
  for (size_t g = 0; g < groups.size(); ++g) {
    const GroupSummary& s = summaries[g];
    table += "<tr>" + td(escapeXml(groups[g].label())) + td(std::to_string(groups[g].particles));
    if (withSuccess) table += td(successCell(s));
    table += td(std::to_string(s.done) + (s.failed ? ", " + std::to_string(s.failed) + "&#160;failed" : ""));
    for (const Figure figure : shown) table += td(figureCell(s, figure, withSuccess));
    table += "</tr>\n";
  }
  return table + "</table></div>\n";
}

std::string pairedTable(const std::vector<Group>& groups, const std::vector<GroupSummary>& summaries) {
  std::vector<const FigureName*> shown;
  for (const FigureName& name : kFigureNames)
    for (const GroupSummary& s : summaries)
      if (s.paired[static_cast<size_t>(name.figure)]) {
        shown.push_back(&name);
        break;
      }
  if (shown.empty()) return {};
  const bool withSuccess = summaries[0].successes.has_value();
  std::string table = "<div class=\"wide\"><table>\n<tr>" + th("group") + th("seeds in both");
  if (withSuccess) table += th("success");
  for (const FigureName* name : shown) table += th(escapeXml(name->title));
  table += "</tr>\n";
  for (size_t g = 1; g < groups.size(); ++g) {
    const auto& firstShown = summaries[g].paired[static_cast<size_t>(shown[0]->figure)];
    table +=
        "<tr>" + td(escapeXml(groups[g].name())) + td(std::to_string(firstShown ? firstShown->pairs : 0));
    if (withSuccess) table += td("<small>sign&#160;p&#160;" + pValue(summaries[g].successSignP) + "</small>");
    for (const FigureName* name : shown) {
      const auto& p = summaries[g].paired[static_cast<size_t>(name->figure)];
      if (!p || p->pairs == 0) {
        table += td(kNothing);
        continue;
      }
      table += td(
          (p->ratio ? shortNumber(p->ratio->ratio, 3) + range(p->ratio->interval.low, p->ratio->interval.high)
                    : std::string(kNothing)) +
          "<small>p&#160;" + pValue(p->wilcoxonP) + "</small><small>sign&#160;p&#160;" + pValue(p->signP) +
          "</small>");
    }
    table += "</tr>\n";
  }
  return table + "</table></div>\n";
}

std::string failureTable(const std::vector<Group>& groups, const std::vector<RunResult>& results) {
  std::string rows;
  for (const RunResult& r : results)
    if (r.status == RunResult::Status::failed)
      rows += "<tr>" + td(escapeXml(groups[r.run.group].name())) + td(std::to_string(r.run.seed)) +
              "<td class=\"text\">" + escapeXml(r.error) + "</td></tr>\n";
  if (rows.empty()) return {};
  return "<div class=\"wide\"><table>\n<tr>" + th("group") + th("seed") + th("error") + "</tr>\n" + rows +
         "</table></div>\n";
}

}  // namespace hybrid_slam::comparison
