#include "study/comparison/SpreadTable.h"

#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "base/Numbers.h"
#include "files/LineReader.h"
#include "study/comparison/TableLine.h"

namespace hybrid_slam::comparison {
std::vector<SpreadStep> loadSpread(const std::string& file) {
  files::LineReader in(file);
  std::string line;
  in.next(line);
  std::map<std::string, size_t> columns;
  for (const std::string& name : splitAtCommas(line)) columns.emplace(name, columns.size());

  std::vector<SpreadStep> steps;
  try {
    const size_t timestamp = columns.at("timestamp");
    const std::array<size_t, kSpreads> spreads{columns.at("std_along"), columns.at("std_across"),
                                               columns.at("std_phi"), columns.at("std_x"),
                                               columns.at("std_y")};
    bool isFirst = true;
    while (in.next(line)) {
      const std::vector<std::string> fields = splitAtCommas(line);
      SpreadStep step{parseNumber(fields.at(timestamp)).value(), {}};
      for (size_t s = 0; s < kSpreads; ++s) step.spread[s] = parseNumber(fields.at(spreads[s])).value();
      step.spread[2] *= mrpt::RAD2DEG(1.0);
      if (isFirst)
        isFirst = false;
      else
        steps.push_back(step);
    }
  } catch (const std::exception&) {  // no such column, no such field, no number
    throw std::runtime_error("broken table: " + file);
  }
  return steps;
}

Spread meanSpread(const std::vector<SpreadStep>& steps) {
  Spread mean{};
  for (const SpreadStep& step : steps)
    for (size_t s = 0; s < kSpreads; ++s) mean[s] += step.spread[s] / static_cast<double>(steps.size());
  return mean;
}

SpreadBands spreadBands(const std::vector<std::vector<SpreadStep>>& runs, size_t times) {
  SpreadBands out;
  double first = INFINITY, last = -INFINITY;
  for (const auto& run : runs)
    for (const SpreadStep& step : run)
      first = std::min(first, step.timestamp), last = std::max(last, step.timestamp);
  if (first > last) return out;
  for (size_t i = 0; i < times; ++i) {
    const double time = first + (last - first) * static_cast<double>(i) / static_cast<double>(times - 1);
    std::array<std::vector<double>, kSpreads> values;
    for (const auto& run : runs) {
      const SpreadStep* before = nullptr;
      for (const SpreadStep& step : run)
        if (step.timestamp <= time) before = &step;
      for (size_t s = 0; before && s < kSpreads; ++s) values[s].push_back(before->spread[s]);
    }
    if (values[0].empty()) continue;
    out.times.push_back(time - first);
    for (size_t s = 0; s < kSpreads; ++s) out.bands[s].push_back(quartiles(values[s]));
  }
  return out;
}

}  // namespace hybrid_slam::comparison
