#include "run/StepsTable.h"

#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <sstream>
#include <string_view>

#include "base/Numbers.h"

namespace hybrid_slam::run {
namespace {

/// Counts a loop in loops_closed and loop_shift, the fourth and third field from the end of a row.
void addLoop(std::string& row, double shift) {
  const size_t frames = row.rfind(','), degeneracy = row.rfind(',', frames - 1);
  const size_t middle = row.rfind(',', degeneracy - 1), first = row.rfind(',', middle - 1);
  const auto between = [&row](size_t comma, size_t next) {
    return parseNumber(std::string_view(row).substr(comma + 1, next - comma - 1)).value_or(0);
  };
  const double closed = between(first, middle), before = between(middle, degeneracy);
  row.replace(first + 1, degeneracy - first - 1,
              fixedText(closed + 1, 0) + ',' + fixedText(std::max(before, shift), 6));
}

}  // namespace

void writeStepsHeader(std::ostream& out) {
  out << "timestamp,particles,ess,resampled,std_x,std_y,std_phi,std_along,std_across,w_grid_best,w_line_best,"
         "lines_seen,lines_matched,step_ms,matched,slipped,"
         "loops_closed,loop_shift,degeneracy,frames_deg\n";
}

void writeStep(std::ostream& out, double timestamp, const FilterStep& s, double milliseconds) {
  const auto number = [&out](double value, int decimals) { out << fixedText(value, decimals) << ','; };
  number(timestamp, 6);
  out << s.particles << ',';
  number(s.ess, 6);
  if (s.resampled) out << (*s.resampled ? 1 : 0);
  out << ',';
  for (const double spread : {s.stdX, s.stdY, s.stdPhi, s.stdAlong, s.stdAcross}) number(spread, 6);
  for (const auto& weight : {s.gridWeight, s.lineWeight})
    if (weight)
      number(*weight, 6);
    else
      out << ',';
  out << s.linesSeen << ',' << s.linesMatched << ',';
  number(milliseconds, 3);
  if (s.matched)
    number(*s.matched, 3);
  else
    out << ',';
  if (s.slipped) out << (*s.slipped ? 1 : 0);
  out << ',' << (s.loop ? 1 : 0) << ',' << fixedText(s.loop ? s.loop->shift : 0, 6) << ',';
  if (s.degeneracy) out << fixedText(*s.degeneracy, 4);
  out << ',';
  for (size_t i = 0; i < s.frames.size(); ++i)
    out << (i > 0 ? " " : "") << fixedText(mrpt::RAD2DEG(s.frames[i].direction), 2);
  out << '\n';
}

std::string withLoops(const std::string& table, const std::vector<LoopClosure>& loops) {
  if (loops.empty()) return table;
  std::istringstream in(table);
  std::string all, line;
  for (size_t i = 0; std::getline(in, line); ++i) {
    for (const LoopClosure& loop : loops)
      if (loop.later + 1 == i) addLoop(line, loop.shift);  // after the header
    all += line + '\n';
  }
  return all;
}

void writeParticlesHeader(std::ostream& out) { out << "timestamp,x,y,phi,log_weight\n"; }

void writeParticles(std::ostream& out, double timestamp, const FilterStep& step) {
  for (const auto& [pose, logWeight] : step.poses) {
    for (const double value : {timestamp, pose.x, pose.y, pose.phi}) out << fixedText(value, 6) << ',';
    out << numberText(logWeight, std::chars_format::general, 6) << '\n';
  }
}

}  // namespace hybrid_slam::run
