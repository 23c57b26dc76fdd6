#include "study/comparison/Summary.h"

#include <map>
#include <nlohmann/json.hpp>

namespace hybrid_slam::comparison {
namespace {

constexpr uint64_t kBootstrapSeed = 1;

using BySeed = std::map<int, double>;

BySeed valuesOf(size_t group, Figure figure, const std::vector<RunResult>& results) {
  BySeed values;
  for (const RunResult& r : results) {
    if (r.run.group != group) continue;
    if (r[figure])
      values[r.run.seed] = *r[figure];
    else if (figure == Figure::success && r.status == RunResult::Status::failed)
      values[r.run.seed] = 0;
  }
  return values;
}

FigureSummary summariseFigure(const BySeed& values, const BySeed& success) {
  std::vector<double> plain, successful;
  for (const auto& [seed, value] : values) {
    plain.push_back(value);
    const auto outcome = success.find(seed);
    if (outcome != success.end() && outcome->second > 0) successful.push_back(value);
  }
  FigureSummary summary;
  summary.runs = plain.size();
  if (!plain.empty()) summary.quartiles = quartiles(plain);
  summary.successfulRuns = successful.size();
  if (!successful.empty()) summary.successfulMedian = interpolatedQuantile(successful, 0.5);
  return summary;
}

PairedComparison compare(const BySeed& values, const BySeed& first) {
  std::vector<double> ours, theirs, differences;
  for (const auto& [seed, value] : values) {
    const auto other = first.find(seed);
    if (other == first.end()) continue;
    ours.push_back(value);
    theirs.push_back(other->second);
    differences.push_back(value - other->second);
  }
  PairedComparison comparison;
  comparison.pairs = ours.size();
  comparison.ratio = medianRatio(ours, theirs, kBootstrapSeed);
  comparison.wilcoxonP = wilcoxonSignedRank(differences);
  comparison.signP = signTest(differences);
  return comparison;
}

}  // namespace

std::vector<GroupSummary> groupSummaries(size_t groups, const std::vector<RunResult>& results) {
  std::vector<GroupSummary> summaries(groups);
  for (const RunResult& r : results) {
    summaries[r.run.group].done += r.status == RunResult::Status::done;
    summaries[r.run.group].failed += r.status == RunResult::Status::failed;
  }
  bool hasCriterion = false;
  for (const RunResult& r : results) hasCriterion |= r[Figure::success].has_value();
  for (const FigureName& name : kFigureNames) {
    const auto f = static_cast<size_t>(name.figure);
    const BySeed first = valuesOf(0, name.figure, results);
    for (size_t g = 0; g < groups; ++g) {
      GroupSummary& summary = summaries[g];
      const BySeed values = valuesOf(g, name.figure, results);
      if (name.figure == Figure::success) {
        if (!hasCriterion) continue;
        summary.successes = 0;
        for (const auto& [seed, value] : values) *summary.successes += value > 0;
        if (!values.empty())
          summary.successRate = static_cast<double>(*summary.successes) / static_cast<double>(values.size());
        summary.successInterval = wilsonInterval(*summary.successes, values.size());
        if (g > 0) summary.successSignP = compare(values, first).signP;
        continue;
      }
      summary.figures[f] =
          summariseFigure(values, name.isError ? valuesOf(g, Figure::success, results) : BySeed());
      if (g > 0 && name.isError && !values.empty() && !first.empty())
        summary.paired[f] = compare(values, first);
    }
  }
  return summaries;
}

void writeSummary(const std::vector<Group>& groups, const std::vector<GroupSummary>& summaries,
                  std::ostream& out) {
  out << "method,variant,particles,done,failed,successes,success_rate,success_low,success_high,success_sign_"
         "p,"
         "figure,runs,q1,median,q3,pairs,median_ratio,ratio_low,ratio_high,wilcoxon_p,sign_p,"
         "successful_runs,successful_median\n";
  const auto row = [&out](const std::vector<std::string>& cells) {
    for (size_t i = 0; i < cells.size(); ++i) out << (i == 0 ? "" : ",") << cells[i];
  };
  for (size_t g = 0; g < groups.size(); ++g) {
    const GroupSummary& s = summaries[g];
    std::vector<std::string> group{groups[g].method, groups[g].variant.name,
                                   std::to_string(groups[g].particles), std::to_string(s.done),
                                   std::to_string(s.failed)};
    if (s.successes && s.ended() > 0)
      group.insert(group.end(),
                   {std::to_string(*s.successes), cell(s.successRate), cell(s.successInterval.low),
                    cell(s.successInterval.high), g > 0 ? cell(s.successSignP) : ""});
    else
      group.insert(group.end(), 5, "");
    if (s.done == 0) {  // a row without figures
      row(group);
      out << std::string(13, ',') << '\n';
    }
    for (const FigureName& name : kFigureNames) {
      const auto f = static_cast<size_t>(name.figure);
      const auto& q = s.figures[f].quartiles;
      if (!q) continue;
      row(group);
      out << ',';
      row({name.column, std::to_string(s.figures[f].runs), cell(q->lower), cell(q->median), cell(q->upper)});
      const auto& p = s.paired[f];
      const bool hasRatio = p && p->ratio;
      out << ',';
      row({p ? std::to_string(p->pairs) : "", hasRatio ? cell(p->ratio->ratio) : "",
           hasRatio ? cell(p->ratio->interval.low) : "", hasRatio ? cell(p->ratio->interval.high) : "",
           p ? cell(p->wilcoxonP) : "", p ? cell(p->signP) : ""});
      out << ',';
      const bool hasOutcome = name.isError && s.successes;
      row({hasOutcome ? std::to_string(s.figures[f].successfulRuns) : "",
           cell(s.figures[f].successfulMedian)});
      out << '\n';
    }
  }
}

nlohmann::ordered_json summaryJson(const std::vector<Group>& groups,
                                   const std::vector<GroupSummary>& summaries) {
  using Json = nlohmann::ordered_json;
  Json all = Json::array();
  for (size_t g = 0; g < groups.size(); ++g) {
    const GroupSummary& s = summaries[g];
    Json group{{"group", groups[g].name()},
               {"method", groups[g].method},
               {"variant", groups[g].variant.name},
               {"settings", groups[g].variant.settings},
               {"particles", groups[g].particles},
               {"done", s.done},
               {"failed", s.failed}};
    if (s.successes) {
      group["success"] = {{"successes", *s.successes},
                          {"rate", s.successRate},
                          {"wilson_95", {s.successInterval.low, s.successInterval.high}}};
      if (g > 0) group["success"]["sign_p"] = s.successSignP;
    }
    for (const FigureName& name : kFigureNames) {
      const auto f = static_cast<size_t>(name.figure);
      const auto& q = s.figures[f].quartiles;
      if (!q) continue;
      Json figure{{"runs", s.figures[f].runs}, {"q1", q->lower}, {"median", q->median}, {"q3", q->upper}};
      if (const auto& p = s.paired[f]) {
        Json against{{"group", groups[0].name()}, {"pairs", p->pairs}, {"median_ratio", nullptr}};
        if (p->ratio) {
          against["median_ratio"] = p->ratio->ratio;
          against["ratio_95"] = {p->ratio->interval.low, p->ratio->interval.high};
        }
        against["wilcoxon_p"] = p->wilcoxonP;
        against["sign_p"] = p->signP;
        figure["against_first"] = against;
      }
      if (const auto& median = s.figures[f].successfulMedian)
        figure["successful"] = {{"runs", s.figures[f].successfulRuns}, {"median", *median}};
      group["figures"][name.column] = figure;
    }
    all.push_back(group);
  }
  return {{"groups", all}};
}

}  // namespace hybrid_slam::comparison
